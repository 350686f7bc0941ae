#include "tools/report/draw/figure_data.h"

#include <gtest/gtest.h>

namespace warmjoint::report {
namespace {

TEST(FigureCsv, HoldsEveryNumberWithAllItsDigits) {
  Plot plot;
  plot.x = {"time (s)", 0, 10, Scale::linear, {}};
  plot.y = {"torque (N·m)", -2, 2, Scale::linear, {}};
  const Eigen::Vector2d x(0, 1), y(1.0 / 3, std::nan(""));
  plot.series = {{"a, b", Hue::blue, Line{x, y}},
                 {"", Hue::blue, Band{x, y, 2 * y}},
                 {"", Hue::text, LevelLine{0.5}},
                 {"", Hue::text, HeatMap{Eigen::MatrixXd{{7}}, {0, 2}, {0, 4}, {0, 1}, "z"}},
                 {"", Hue::text, Note{0, 0, "words"}}};
  Figure figure;
  figure.panels = {{"", plot}, {"Words", Words{}}};
  EXPECT_EQ(FigureCsv(figure),
            "# panel 1: x is time (s); y is torque (N·m)\n"
            "panel,series,kind,x,y,lower,upper,value\n"
            "panel 1,\"a, b\",line,0,0.3333333333333333,,,\n"
            "panel 1,\"a, b\",line,1,,,,\n"
            "panel 1,series 2,band,0,,0.3333333333333333,0.6666666666666666,\n"
            "panel 1,series 2,band,1,,,,\n"
            "panel 1,series 3,level,,0.5,,,\n"
            "panel 1,series 4,cell,1,2,,,7\n");
}

}  // namespace
}  // namespace warmjoint::report
