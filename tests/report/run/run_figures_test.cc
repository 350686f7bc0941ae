#include "tools/report/run/run_figures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/report/look.h"
#include "tests/report/run_example.h"

namespace warmjoint::report {
namespace {

using ::testing::HasSubstr;

bool Writes(const Drawn& drawn, const std::string& words) {
  return std::any_of(drawn.texts.begin(), drawn.texts.end(), [&](const DrawnText& text) {
    return text.text.find(words) != std::string::npos;
  });
}

TEST(RunFigures, AreTidyAndNamedAsTheirFiles) {
  const RunView run = ExampleRun();
  for (const RunFigure& one : RunFigures()) {
    SCOPED_TRACE(one.name);
    const std::optional<Figure> figure = one.make(run);
    ASSERT_TRUE(figure.has_value());
    EXPECT_EQ(figure->name, one.name);
    EXPECT_FALSE(one.summary.empty());
    DrawLight(*figure);
  }
}

TEST(RunFigures, AreLeftOutWhereTheRunHasNoDataForThem) {
  RunView run = ExampleRun();
  run.rows.clear();
  for (const RunFigure& one : RunFigures()) EXPECT_FALSE(one.make(run)) << one.name;
}

TEST(NpeBoxes, StandInTheIdentifiersColoursWithTheFailuresWrittenOut) {
  const RunView run = ExampleRun();
  const Figure figure = *NpeBoxes(run);
  const Drawn drawn = DrawLight(figure);
  const DrawnPlot& plot = drawn.plots.at(0);
  EXPECT_EQ(plot.series[0].colour, LightTheme().Colour(IdentifierHue("energy-ml")));
  EXPECT_NEAR(plot.series[0].y.second, 100 * run.rows[0].npe.maxCoeff(), 1e-9) << "outliers too";
  EXPECT_EQ(SeriesNamed(plot, "Cramér-Rao bound (rms)").y.first, 1.2);
  EXPECT_TRUE(Writes(drawn, "12 of 40 not_converged"));
  EXPECT_THAT(figure.finding, HasSubstr("with 12 of 40 failed"));
}

TEST(NpeBoxes, NameAnIdentifierThatNeverAnswered) {
  RunView run = ExampleRun();
  run.rows[1].npe.setConstant(std::nan(""));
  const Figure figure = *NpeBoxes(run);
  EXPECT_TRUE(Writes(DrawLight(figure), "energy-em"));
  EXPECT_THAT(figure.finding, HasSubstr("energy-em, 50 iterations none"));
}

TEST(ParameterCourses, ShowEveryRealizationAndTheTruth) {
  const RunView run = ExampleRun();
  const Figure figure = *ParameterCourses(run);
  const Drawn drawn = DrawLight(figure);
  const DrawnPlot& plot = PlotNamed(drawn, "viscous");
  EXPECT_EQ(SeriesNamed(plot, "realizations").points, kExampleRealizations * 200);
  EXPECT_EQ(SeriesNamed(plot, "truth").y, std::pair(5.0, 5.0));
  EXPECT_EQ(SeriesNamed(plot, "median").colour, LightTheme().Colour(IdentifierHue("energy-em")));
  EXPECT_EQ(drawn.plots.size(), 1u) << "thermal_pole is no parameter of the continuous truth";
}

TEST(AgreementBars, AreMediansOfTheRightNumbers) {
  const RunView run = ExampleRun();
  const Drawn drawn = DrawLight(*AgreementBars(run));
  ASSERT_EQ(drawn.plots.size(), 4u);
  const auto top = [&](const std::string& title) {
    return PlotNamed(drawn, title).series[0].y.second;
  };
  EXPECT_NEAR(top("Fit"), 93, 1);
  EXPECT_NEAR(top("Root mean square error"), 0.5, 0.01);
  EXPECT_NEAR(top("Final prediction error"), 0.25, 0.01);
  EXPECT_NEAR(top("Mean absolute error"), 0.4, 0.01);
}

TEST(IntervalCoverage, ShowsSharesInPerCent) {
  const Drawn drawn = DrawLight(*IntervalCoverage(ExampleRun()));
  const DrawnSeries& shares = SeriesNamed(drawn.plots.at(0), "energy-ml");
  EXPECT_EQ(shares.points, 3);
  EXPECT_NEAR(shares.y.first, 95, 1e-9) << "38 of 40";
  EXPECT_TRUE(Writes(drawn, "τ")) << "symbols";
}

TEST(ParameterPairs, HoldTheirEllipsesAndThatOfTheBound) {
  const Drawn drawn = DrawLight(*ParameterPairs(ExampleRun()));
  ASSERT_EQ(drawn.plots.size(), 3u);
  const DrawnPlot& plot = drawn.plots[0];  // viscous, coulomb: deviations of 1 and 2 per cent
  const DrawnSeries& bound = SeriesNamed(plot, "Cramér-Rao bound");
  // sqrt(chi^2 of 2 degrees at 95 %) = 2.4477; 121 points miss the tip by 1 - cos(1.5 deg) at most
  EXPECT_NEAR(bound.x.second, 2.4477, 0.001);
  EXPECT_NEAR(bound.y.second, 2 * 2.4477, 0.002);
  // 40 draws: their deviation is known to 11 %, three times that here
  EXPECT_NEAR(SeriesNamed(plot, "their 95 % ellipse").x.second, 2.4477, 0.9);
}

}  // namespace
}  // namespace warmjoint::report
