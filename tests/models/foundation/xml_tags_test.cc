#include "models/foundation/xml_tags.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace warmjoint {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> Names(std::string_view text) {
  std::vector<std::string> names;
  XmlTagReader reader(text);
  while (const auto tag = reader.Next()) {
    static constexpr const char* marks[]{"", "/", "."};
    names.push_back(marks[static_cast<int>(tag->kind)] + std::string(tag->name));
  }
  return names;
}

TEST(XmlTags, ComeInOrderWithTheirKind) {
  EXPECT_THAT(Names("<a><b x='1'/>text</a>"), ElementsAre("a", ".b", "/a"));
}

TEST(XmlTags, PassOverWhatIsNoTag) {
  EXPECT_THAT(Names("<?xml v='<a>'?><!DOCTYPE a><!-- <b> --><![CDATA[<c>]]><d/>"),
              ElementsAre(".d"));
}

TEST(XmlTags, EndAtTheEndOfBrokenText) {
  EXPECT_THAT(Names(""), IsEmpty());
  EXPECT_THAT(Names("<!-- never closed <a>"), IsEmpty());
  EXPECT_THAT(Names("<a b='never closed><c>"), ElementsAre("a"));
  EXPECT_THAT(Names("<"), ElementsAre(""));
  EXPECT_THAT(Names("<>"), ElementsAre(""));
}

TEST(XmlTags, KnowTheirLineAndAttributes) {
  XmlTagReader reader("\n\n<a one = \"1 > 0\"\n two='2'/>\n<b/>");
  const auto a = reader.Next();
  ASSERT_TRUE(a);
  EXPECT_EQ(a->line, 3);
  EXPECT_EQ(a->Attribute("one"), "1 > 0");
  EXPECT_EQ(a->Attribute("two"), "2");
  EXPECT_EQ(a->Attribute("wo"), std::nullopt);
  const auto b = reader.Next();
  ASSERT_TRUE(b);
  EXPECT_EQ(b->line, 5);
}

}  // namespace
}  // namespace warmjoint
