#include "tools/report/run/run_figures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/report/look.h"
#include "tests/tools/report/run_example.h"
#include "tests/tools/scratch_directory.h"
#include "tools/report/run/run_view.h"

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

TEST(NpeBoxes, HaveNoBoundWhereVariantsHaveOneEach) {
  const Figure figure = *NpeBoxes(ExampleRun());
  for (const Series& series : std::get<Plot>(figure.panels[0].content).series) {
    EXPECT_FALSE(std::holds_alternative<LevelLine>(series.shape)) << series.label;
  }
  EXPECT_EQ(figure.finding.find("bound"), std::string::npos);
}

TEST(NpeBoxes, StandInTheIdentifiersColoursWithTheFailuresWrittenOut) {
  RunView run = ExampleRun();
  run.rungs = {};
  const Figure figure = *NpeBoxes(run);
  const Drawn drawn = DrawLight(figure);
  const DrawnPlot& plot = drawn.plots.at(0);
  EXPECT_EQ(plot.series[0].colour, LightTheme().Colour(IdentifierHue("energy-ml")));
  EXPECT_NEAR(plot.series[0].y.second, 100 * run.rows[0].npe.maxCoeff(), 1e-9) << "outliers too";
  // an rms beside the bound's
  EXPECT_EQ(SeriesNamed(plot, "Cramér-Rao bound (rms)").y.first, 1.2);
  const double rms = std::sqrt(run.rows[0].npe.squaredNorm() / kExampleRealizations);
  EXPECT_NEAR(SeriesNamed(plot, "root mean square").y.first, 100 * rms, 1e-9);
  EXPECT_TRUE(Writes(drawn, "12 of 40 not converged"));
  EXPECT_THAT(figure.finding, HasSubstr("with 12 of 40 failed"));
}

TEST(Ladder, ShowsMediansAtTheRungsWithTheBound) {
  const RunView run = ExampleRun();
  const Figure figure = *LadderFigure(run);
  const Drawn drawn = DrawLight(figure);
  const DrawnPlot& plot = drawn.plots.at(0);
  const DrawnSeries& ml = SeriesNamed(plot, "energy-ml");
  EXPECT_EQ(ml.x, std::pair(0.1, 1.0));
  EXPECT_EQ(ml.colour, LightTheme().Colour(IdentifierHue("energy-ml")));
  // medians of 20 of NPE 1.1 % spread by a factor e^0.3: known to 1.25 0.3 / sqrt(20) = 8 %
  EXPECT_NEAR(ml.y.second, 1.1, 4 * 0.08 * 1.1);
  // the bounds of the columns are 1, 2 and 3 %
  const DrawnSeries& bound = SeriesNamed(plot, "Cramér-Rao bound (rms)");
  EXPECT_NEAR(bound.y.first, std::sqrt(14), 1e-9);
  EXPECT_TRUE(Writes(drawn, "torque noise (N·m)"));
  EXPECT_THAT(figure.finding, HasSubstr("from the first rung of torque noise to the last"));
}

TEST(ParameterCourses, ShowWhereMostRealizationsRunAndTheTruth) {
  RunView run = ExampleRun();
  const Figure figure = *ParameterCourses(run);
  const Drawn drawn = DrawLight(figure);
  const DrawnPlot& plot = PlotNamed(drawn, "viscous, k_{v}");
  // starts are evenly between 5 1.5 and 5 2.5 times 0.95 at the first iteration
  const DrawnSeries& band = SeriesNamed(plot, "middle 80 %");
  EXPECT_NEAR(band.y.second, 5 * (1 + 1.4 * std::exp(-0.05)), 0.02);
  EXPECT_EQ(SeriesNamed(plot, "truth").y, std::pair(5.0, 5.0));
  EXPECT_EQ(SeriesNamed(plot, "median").colour, LightTheme().Colour(IdentifierHue("energy-als")));
  EXPECT_EQ(drawn.plots.size(), 1u) << "thermal_pole is no parameter of the continuous truth";

  // few have a line each
  Course& course = run.rows[1].course;
  course.parameters[0] = course.parameters[0].topRows(3).eval();
  const Drawn few = DrawLight(*ParameterCourses(run));
  EXPECT_EQ(SeriesNamed(PlotNamed(few, "viscous, k_{v}"), "realizations").points, 3 * 200);
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

constexpr int kRealizations = 50;

/// Realization i, whose NPE is i; every second interval holds the truth, every tenth answer fails.
Realization Numbered(int i) {
  Result result;
  result.realization = i;
  result.status = i % 10 == 9 ? "not_converged" : "ok";
  const ParameterScore one{"coulomb", 15, 15.0 + i, true, i % 2 == 0, 0.5};
  result.metrics = Metrics{100, 1, 1, 0.5, 0.4, 95, 0.25};
  const auto npe = static_cast<double>(i);
  result.score = Score{{one}, {one}, npe, npe, 0.05, 0.05};
  return {{0, i}, 0.1, {result}};
}

RunView ReadNumbered(std::int64_t most_drawn) {
  const ScratchDirectory scratch;
  const RunDescription description{
      "name: little\nquestion: How much is drawn?\nseed: 7\nrealizations: 50\nidentifiers: "
      "[{name: nominal-ls}]\n"
      "scenario: {friction: {law: viscous_coulomb, parameters: {viscous: 5, coulomb: 15}},"
      " motion: {speeds: [1], hold: 2}, sampling: {rate: 10}, duration: 20}\n",
      {{"warmjoint", "0.1.0"}}};
  RunStore store = RunStore::CreateOrResume(scratch.path() / "run", description);
  std::vector<Realization> all;
  for (int i = 0; i < kRealizations; ++i) all.push_back(Numbered(i));
  store.Write(all);
  return ReadRunView(store, most_drawn);
}

TEST(ReadRunView, DrawsAllOfAShortRun) {
  const RunView view = ReadNumbered(kMostDrawn);
  EXPECT_EQ(view.drawn_every, 1);
  EXPECT_EQ(view.rows.at(0).npe, Eigen::VectorXd::LinSpaced(kRealizations, 0, kRealizations - 1));
}

TEST(ReadRunView, DrawsOneInSeveralOfALongOneAndCountsAll) {
  const RunView view = ReadNumbered(10);
  EXPECT_EQ(view.drawn_every, 5);
  EXPECT_EQ(view.realizations, kRealizations);
  const RunRow& row = view.rows.at(0);
  EXPECT_EQ(row.npe, Eigen::VectorXd::LinSpaced(10, 0, 45));
  EXPECT_EQ(row.parameters.at(0).estimate, (Eigen::VectorXd::LinSpaced(10, 15, 60)));
  EXPECT_EQ(row.runs, kRealizations);
  EXPECT_EQ(row.failures.at("not_converged"), 5);
  EXPECT_EQ(row.parameters[0].intervals, kRealizations);
  EXPECT_EQ(row.parameters[0].covered, kRealizations / 2);
}

}  // namespace
}  // namespace warmjoint::report
