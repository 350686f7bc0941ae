#include "tools/report/figures/error_by_iteration.h"

#include <gtest/gtest.h>

#include "tests/tools/report/look.h"

namespace warmjoint::report {
namespace {

using Eigen::VectorXd;

QuartileCurve Falling(int iterations, double from, double to) {
  const VectorXd x = VectorXd::LinSpaced(iterations, 1, iterations);
  const VectorXd y = VectorXd::LinSpaced(iterations, from, to);
  return {x, 0.8 * y, y, 1.2 * y};
}

ErrorByIteration Example() {
  ErrorByIteration data;
  data.suite = "table1";
  data.realizations = 50;
  data.cramer_rao = 0.012;
  data.noise = 0.5;
  data.identifiers = {
      {"nominal-ls", "nominal-ls", Falling(1, 1.2, 1.2), Falling(1, 0.9, 0.9)},
      {"energy-als 50", "energy-als", Falling(50, 1, 0.2), Falling(50, 0.8, 0.55)},
      {"energy-als 500", "energy-als", Falling(500, 1, 0.01), Falling(500, 0.8, 0.5)},
  };
  return data;
}

TEST(ErrorByIteration, DrawsMediansInTheIdentifiersColours) {
  const Drawn drawn = DrawTidy(MakeErrorByIteration(Example()));
  ASSERT_EQ(drawn.plots.size(), 2u);
  const DrawnPlot& npe = PlotNamed(drawn, "Normalised parameter error");
  const DrawnSeries& em = SeriesNamed(npe, "energy-als 500");
  EXPECT_EQ(em.colour, LightTheme().Colour(IdentifierHue("energy-als")));
  EXPECT_EQ(em.x, std::pair(1.0, 500.0));
  EXPECT_NEAR(em.y.first, 1, 1e-12) << "per cent";
  EXPECT_NEAR(em.y.second, 100, 1e-12);
  EXPECT_EQ(SeriesNamed(npe, "median at the Cramér-Rao bound").y, std::pair(1.2, 1.2));
  EXPECT_EQ(SeriesNamed(npe, "nominal-ls").x, std::pair(1.0, 500.0)) << "a level";

  const DrawnPlot& rmse = PlotNamed(drawn, "Root mean square error of the fit");
  EXPECT_EQ(SeriesNamed(rmse, "noise").y, std::pair(0.5, 0.5));
  EXPECT_EQ(SeriesNamed(rmse, "energy-als 50").y, std::pair(0.55, 0.8));
}

TEST(ErrorByIteration, ShowsTheQuartilesAsABandOfTheSameColour) {
  const Drawn drawn = DrawTidy(MakeErrorByIteration(Example()));
  const DrawnPlot& npe = PlotNamed(drawn, "Normalised parameter error");
  // the band of energy-als 500 stands alone at its end: median 1 %, quartiles 0.8 and 1.2 %
  const DrawnSeries* band = nullptr;
  for (const DrawnSeries& series : npe.series) {
    if (series.label.empty() && std::abs(series.y.first - 0.8) < 1e-9) band = &series;
  }
  ASSERT_NE(band, nullptr);
  EXPECT_NEAR(band->y.second, 120, 1e-9);
  EXPECT_EQ(band->colour, LightTheme().Colour(Hue::vermilion));
}

}  // namespace
}  // namespace warmjoint::report
