#include "tools/terminal/table.h"

#include <gtest/gtest.h>

namespace warmjoint {
namespace {

TEST(Table, AlignsWordsToTheLeftAndNumbersToTheRightByCharacters) {
  const Table table{{"#", "name", "first", "second"},
                    {{"1", "energy-ml", "1.25 %", "0.5 .. 0.7"}, {"2", "Cramér", "3 %", ""}}};
  EXPECT_EQ(TableToText(table, 2),
            "#  name        first      second\n"
            "--------------------------------\n"
            "1  energy-ml  1.25 %  0.5 .. 0.7\n"
            "2  Cramér        3 %\n");
}

}  // namespace
}  // namespace warmjoint
