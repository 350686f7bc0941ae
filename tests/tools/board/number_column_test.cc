#include "tools/board/number_column.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

#include "models/foundation/output_failed.h"

namespace warmjoint {
namespace {

std::vector<double> All(const NumberColumn& column) {
  std::vector<double> all;
  column.ForEach([&](double value) { all.push_back(value); });
  return all;
}

TEST(NumberColumn, GivesBackWhatWasAdded) {
  // none, part of a block, whole blocks, and more
  for (const int size : {0, 3, 1024, 2048, 5000}) {
    NumberColumn column;
    std::vector<double> added;
    for (int i = 0; i < size; ++i) added.push_back(0.1 * i);
    for (const double value : added) column.Add(value);
    EXPECT_EQ(column.size(), added.size());
    EXPECT_EQ(All(column), added);
  }
}

TEST(NumberColumn, ColumnsOfOneFileDoNotMix) {
  const auto file = std::make_shared<NumberFile>();
  NumberColumn a(file), b(file);
  for (int i = 0; i < 3000; ++i) {
    a.Add(i);
    b.Add(-i);
  }
  a.Add(b);
  ASSERT_EQ(a.size(), 6000u);
  const std::vector<double> all = All(a);
  EXPECT_EQ(all[2999], 2999);
  EXPECT_EQ(all[3001], -1);
  EXPECT_EQ(all[5999], -2999);
}

TEST(NumberColumn, PairsEndWithTheShorterColumn) {
  NumberColumn a, b;
  for (int i = 0; i < 3000; ++i) a.Add(i);
  for (int i = 0; i < 2500; ++i) b.Add(2 * i);
  int pairs = 0;
  ForEachPair(a, b, [&](double x, double y) {
    EXPECT_EQ(y, 2 * x);
    ++pairs;
  });
  EXPECT_EQ(pairs, 2500);
}

TEST(NumberColumn, SaysThatItsFileCannotBeMade) {
  const char* before = std::getenv("TMPDIR");
  const std::string kept = before ? before : "";
  setenv("TMPDIR", "/nowhere", 1);
  NumberColumn column;
  const auto fill = [&] {
    for (int i = 0; i < 1024; ++i) column.Add(i);
  };
  EXPECT_THROW(fill(), OutputFailed);
  before ? setenv("TMPDIR", kept.c_str(), 1) : unsetenv("TMPDIR");
}

}  // namespace
}  // namespace warmjoint
