#include "tools/terminal/table.h"

#include <gmock/gmock.h>

#include "tools/terminal/wrap.h"

namespace warmjoint {
namespace {

Table Numbers() {
  return {{"#", "name", "first", "second", "third"},
          {{"1", "energy-ml", "1.25 %", "0.5 .. 0.7", "12"}, {"2", "em", "3 %", "-", "400"}}};
}

TEST(Table, StandsInOneBlockWhereItFits) {
  EXPECT_EQ(TableToText(Numbers(), 2, 80),
            "#  name        first      second  third\n"
            "---------------------------------------\n"
            "1  energy-ml  1.25 %  0.5 .. 0.7     12\n"
            "2  em            3 %           -    400\n");
}

TEST(Table, RepeatsItsFirstColumnsWhereTheOthersDoNotFit) {
  EXPECT_EQ(TableToText(Numbers(), 2, 32),
            "#  name        first      second\n"
            "--------------------------------\n"
            "1  energy-ml  1.25 %  0.5 .. 0.7\n"
            "2  em            3 %           -\n"
            "\n"
            "#  name       third\n"
            "-------------------\n"
            "1  energy-ml     12\n"
            "2  em           400\n");
}

TEST(Table, BreaksTheLastColumnOfWords) {
  const Table words{
      {"law", "meaning"},
      {{"stribeck", "friction that falls with speed and then grows"}, {"coulomb", "a level"}}};
  EXPECT_EQ(TableToText(words, 2, 34),
            "law       meaning\n"
            "----------------------------------\n"
            "stribeck  friction that falls with\n"
            "          speed and then grows\n"
            "coulomb   a level\n");
}

TEST(Table, HoldsTheWidthForEveryWidthThatACellLeaves) {
  for (int width = 24; width < 60; ++width) {
    for (const std::string& line : Lines(TableToText(Numbers(), 2, width))) {
      EXPECT_LE(ShownWidth(line), width);
    }
  }
}

}  // namespace
}  // namespace warmjoint
