#include "tools/report/page/contact_sheet.h"

#include <gtest/gtest.h>

#include "tests/tools/report/look.h"

namespace warmjoint::report {
namespace {

/// A figure whose second panel is a plot of one level.
Figure LevelAt(double value) {
  Plot plot;
  plot.x = plot.y = {"x", 0, 10, Scale::linear, {}};
  plot.series = {{"", Hue::blue, LevelLine{value, Dash::solid}}};
  Figure figure;
  figure.name = "level_" + std::to_string(static_cast<int>(value));
  figure.title = "Level " + std::to_string(static_cast<int>(value));
  figure.panels = {{"Words", Words{{{"nothing to see", false, Hue::text}}}, 0, 0},
                   {"", plot, 0, 1}};
  figure.columns = {1, 1};
  return figure;
}

TEST(ContactSheet, ShowsThePlotOfEachFigureUnderItsTitleInRowsOfThree) {
  const Figure sheet = MakeContactSheet({LevelAt(1), LevelAt(2), LevelAt(3), LevelAt(4)});
  const Drawn drawn = DrawLight(sheet);
  ASSERT_EQ(drawn.plots.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const double value = static_cast<double>(i) + 1;
    const DrawnPlot& plot = PlotNamed(drawn, "Level " + std::to_string(i + 1));
    EXPECT_TRUE(
        HasColourNear(drawn.image, PixelOf(plot, 5, value), LightTheme().Colour(Hue::blue)));
    // large enough to be read where a page is shown at half its pixels
    EXPECT_GT(plot.area.width(), 200);
  }
  EXPECT_GT(drawn.plots[3].area.top, drawn.plots[0].area.bottom) << "a second row";
  EXPECT_NE(sheet.finding.find("level_4"), std::string::npos);
}

}  // namespace
}  // namespace warmjoint::report
