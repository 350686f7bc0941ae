#include <gtest/gtest.h>

#include "tools/report/draw/draw_series.h"

namespace warmjoint::report {
namespace {

TEST(HeatColour, RunsFromDarkToLightWithoutAnOpenPlot) {
  EXPECT_EQ(HeatColour(0), (Rgb{68, 1, 84}));
  EXPECT_EQ(HeatColour(1), (Rgb{253, 231, 37}));
  EXPECT_EQ(HeatColour(-3), HeatColour(0));
  EXPECT_EQ(HeatColour(7), HeatColour(1));
  const auto lightness = [](Rgb c) { return 0.2126 * c.red + 0.7152 * c.green + 0.0722 * c.blue; };
  for (int i = 0; i < 50; ++i) {
    EXPECT_LT(lightness(HeatColour(i / 50.0)), lightness(HeatColour((i + 1) / 50.0))) << i;
  }
}

}  // namespace
}  // namespace warmjoint::report
