#include "tools/report/figures/kernels.h"

#include <gtest/gtest.h>

#include "tests/tools/report/look.h"

namespace warmjoint::report {
namespace {

TEST(Kernels, OfThePlainKindFallToZeroBeyondTheDataAndNormalisedOnesDoNot) {
  const Figure figure = MakeKernels();
  const Drawn drawn = DrawTidy(figure);
  const Plot& fits = std::get<Plot>(figure.panels[0].content);
  const auto line = [&](std::size_t i) { return std::get<Line>(fits.series[i].shape); };
  const Line truth = line(0), plain = line(2), normalised = line(3);
  const Eigen::Index last = truth.x.size() - 1, edge = 3 * last / 4, middle = last / 2;
  EXPECT_EQ(truth.x[edge], 2);
  // noise of 0.05 on 60 samples for 6 kernels: 0.016, four times; and the kernels' spacing of 0.8
  // cuts the parabola's corners by 0.6 * 0.8^2 / 8 = 0.048. At the edge the plain ones already fall
  constexpr double kClose = 4 * 0.016 + 0.048;
  for (const Line& fit : {plain, normalised}) {
    EXPECT_NEAR(fit.y[middle], -0.5, kClose);
    const Eigen::Index inside = 7 * last / 10;  // t = 1.6, half a spacing from the edge
    EXPECT_NEAR(fit.y[inside], truth.y[inside], kClose);
  }
  EXPECT_NEAR(normalised.y[edge], truth.y[edge], kClose);
  EXPECT_LT(std::abs(plain.y[last]), 0.2 * truth.y[edge]);
  EXPECT_GT(normalised.y[last], 0.9 * truth.y[edge]);

  // and that is what is drawn, in its colours
  const DrawnPlot& plot = drawn.plots[0];
  EXPECT_EQ(SeriesNamed(plot, "plain kernels").colour, LightTheme().Colour(Hue::orange));
  EXPECT_TRUE(HasColourNear(drawn.image, PixelOf(plot, 3.9, normalised.y[last]),
                            LightTheme().Colour(Hue::blue)));
  EXPECT_EQ(drawn.plots[1].series.size(), 6u);
  // two widths and a half beyond the last centre only the kernel before it still counts: 5 %
  EXPECT_NEAR(drawn.plots[2].series[5].y.second, 0.95, 0.01) << "the outermost keeps its value";
}

}  // namespace
}  // namespace warmjoint::report
