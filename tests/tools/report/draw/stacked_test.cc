#include "tools/report/draw/stacked.h"

#include <gtest/gtest.h>

namespace warmjoint::report {
namespace {

/// Two plots side by side below words.
Figure Example(double width) {
  Figure figure;
  figure.width = width;
  figure.height = 0;
  figure.rows = {0, 200};
  figure.columns = {1, 1};
  figure.panels = {{"words", Words{}, 0, 0, 1, 2}, {"right", Plot{}, 1, 1}, {"left", Plot{}, 1, 0}};
  return figure;
}

TEST(Stacked, LeavesAWideFigureAsItIs) {
  const Figure wide = Stacked(Example(960), 0);
  EXPECT_EQ(wide.columns.size(), 2u);
  EXPECT_EQ(wide.panels[1].title, "right");
}

TEST(Stacked, PutsNarrowPlotsOneUnderTheOtherInTheOrderOfReading) {
  const Figure narrow = Stacked(Example(370), 0);
  EXPECT_EQ(narrow.columns.size(), 1u);
  EXPECT_EQ(narrow.rows, (std::vector<double>{0, 200, 200}));
  ASSERT_EQ(narrow.panels.size(), 3u);
  EXPECT_EQ(narrow.panels[1].title, "left");
  EXPECT_EQ(narrow.panels[2].title, "right");
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(narrow.panels[i].row, i);
    EXPECT_EQ(narrow.panels[i].column, 0);
    EXPECT_EQ(narrow.panels[i].column_span, 1);
  }
}

TEST(Stacked, KeepsTheHeightOfPlotsWhereThePageAllowsIt) {
  Figure figure = Example(370);
  figure.panels.erase(figure.panels.begin());
  figure.panels[0].row = figure.panels[1].row = 0;
  figure.rows = {1};
  figure.height = 240;
  EXPECT_EQ(Stacked(figure, 40).rows, (std::vector<double>{200, 200}));
  figure.height = 640;
  EXPECT_EQ(Stacked(figure, 40).rows, (std::vector<double>{277.5, 277.5}))
      << "three quarters of 370";
}

}  // namespace
}  // namespace warmjoint::report
