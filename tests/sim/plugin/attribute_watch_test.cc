// Whether a text is the one that was bound.
#include "sim/plugin/bound_joints.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace warmjoint {
namespace {

TEST(AttributeWatch, TellsAnyDifferenceOfAShortText) {
  std::string text(2000, 'a');
  AttributeWatch watch(text);
  EXPECT_TRUE(watch.Same(text));
  for (size_t i = 0; i < text.size(); i += 7) {
    text[i] = 'b';
    EXPECT_FALSE(watch.Same(text)) << i;
    text[i] = 'a';
    EXPECT_TRUE(watch.Same(text)) << i;
  }
  EXPECT_FALSE(watch.Same(text + "a"));
}

TEST(AttributeWatch, TellsAnyDifferenceOfALongTextThatWasPrepared) {
  std::string text(30000, 'a');
  AttributeWatch watch(text);
  for (size_t i = 0; i < text.size(); i += 131) {
    text[i] = 'b';
    AttributeWatch::Prepared();
    EXPECT_FALSE(watch.Same(text)) << i;
    text[i] = 'a';
    AttributeWatch::Prepared();
    EXPECT_TRUE(watch.Same(text)) << i;
  }
}

TEST(AttributeWatch, TellsADifferentLongTextThatNothingAnnounced) {
  std::string text(30000, 'a');
  AttributeWatch watch(text);
  EXPECT_TRUE(watch.Same(text));
  // both ends, and every stretch that is longer than what is between two blocks
  for (const size_t begin : {size_t{0}, size_t{9000}, text.size() - 2100}) {
    std::string other = text;
    other.replace(begin, 2100, 2100, 'b');
    EXPECT_FALSE(watch.Same(other)) << begin;
  }
  EXPECT_TRUE(watch.Same(text));
}

TEST(AttributeWatch, MarksATextByAFractionOfItsOwn) {
  std::set<double> marks;
  std::string text(200, 'a');
  for (size_t i = 0; i < text.size(); ++i) {
    text[i] = 'b';
    const double mark = AttributeWatch(text).mark();
    EXPECT_GT(mark, 0);
    EXPECT_LT(mark, 1);
    EXPECT_EQ(AttributeWatch(text).mark(), mark);
    marks.insert(mark);
  }
  EXPECT_EQ(marks.size(), text.size());
  // in every process and on every machine
  EXPECT_EQ(AttributeWatch("coulomb").mark(), 0x1.88845b0ab5fa3p-1);
}

TEST(AttributeWatch, IsQuietFromAComparisonToTheNextAnnouncement) {
  const std::string text(100, 'a');
  AttributeWatch watch(text);
  EXPECT_FALSE(watch.Quiet());
  EXPECT_FALSE(watch.Same(std::string(100, 'b')));
  EXPECT_FALSE(watch.Quiet());
  EXPECT_TRUE(watch.Same(text));
  EXPECT_TRUE(watch.Quiet());
  AttributeWatch::Prepared();
  EXPECT_FALSE(watch.Quiet());
}

}  // namespace
}  // namespace warmjoint
