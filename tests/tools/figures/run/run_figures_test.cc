#include "tools/figures/run/run_figures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/tools/figures/look.h"
#include "tests/tools/figures/run/run_example.h"
#include "tests/tools/scratch_directory.h"
#include "tools/figures/run/run_view.h"
#include "tools/figures/symbols.h"

namespace warmjoint::figures {
namespace {

using ::testing::HasSubstr;

/// Whether the words stand anywhere in the figure.
bool Writes(const Figure& figure, const std::string& words) {
  return FigureJson(figure).dump().find(words) != std::string::npos;
}

TEST(RunFigures, AreTidyAndNamedAsTheirFiles) {
  const auto shown = LookAtAll(RunFigures(), ExampleRun());
  for (const RunFigure& one : RunFigures()) EXPECT_TRUE(shown.contains(one.name)) << one.name;
}

TEST(RunFigures, AreLeftOutWhereTheRunHasNoDataForThem) {
  RunView run = ExampleRun();
  run.rows.clear();
  for (const RunFigure& one : RunFigures()) EXPECT_FALSE(one.make(run)) << one.name;
}

TEST(NpeBoxes, PutNoVariantsTogetherAndGiveEachItsBound) {
  RunView run = ExampleRun();
  run.board.groups.resize(2);
  run.board.groups[0].bound_npe_continuous = 0.01;
  run.board.groups[1].bound_npe_continuous = 0.1;
  const Figure figure = *NpeBoxes(run);
  const Shown drawn = Look(figure);
  ASSERT_EQ(drawn.plots.size(), 2u);
  EXPECT_EQ(drawn.plots[1].title, "noise.torque 1 N·m");
  EXPECT_EQ(SeriesNamed(drawn.plots[0], "Cramér-Rao bound (rms)").y.first, 1);
  EXPECT_EQ(SeriesNamed(drawn.plots[1], "Cramér-Rao bound (rms)").y.first, 10);
  // the second half of the realizations is the second variant's
  const auto half = kExampleRealizations / 2;
  EXPECT_NEAR(drawn.plots[1].series[0].y.second, 100 * run.rows[0].npe.tail(half).maxCoeff(), 1e-9);
  EXPECT_EQ(figure.finding.find("bound"), std::string::npos);
}

TEST(NpeBoxes, StandInTheIdentifiersColoursWithTheFailuresWrittenOut) {
  RunView run = ExampleRun();
  run.rungs = {};
  const Figure figure = *NpeBoxes(run);
  const Shown drawn = Look(figure);
  const ShownPlot& plot = drawn.plots.at(0);
  EXPECT_EQ(plot.series[0].hue, IdentifierHue("energy-ml"));
  EXPECT_NEAR(plot.series[0].y.second, 100 * run.rows[0].npe.maxCoeff(), 1e-9) << "outliers too";
  // an rms beside the bound's
  EXPECT_EQ(SeriesNamed(plot, "Cramér-Rao bound (rms)").y.first, 1.2);
  const double rms = std::sqrt(run.rows[0].npe.squaredNorm() / kExampleRealizations);
  EXPECT_NEAR(SeriesNamed(plot, "root mean square").y.first, 100 * rms, 1e-9);
  EXPECT_TRUE(Writes(figure, "12 of 40 not converged"));
  EXPECT_THAT(figure.finding, HasSubstr("with 12 of 40 failed"));
}

TEST(Ladder, ShowsRootMeanSquaresAtTheRungsWithTheBoundWhichIsOne) {
  const RunView run = ExampleRun();
  const Figure figure = *LadderFigure(run);
  const Shown drawn = Look(figure);
  const ShownPlot& plot = drawn.plots.at(0);
  const ShownSeries& ml = SeriesNamed(plot, "energy-ml");
  EXPECT_EQ(ml.x, std::pair(0.1, 1.0));
  EXPECT_EQ(ml.hue, IdentifierHue("energy-ml"));
  const auto half = kExampleRealizations / 2;
  const auto rms = [&](const Eigen::VectorXd& npe) {
    return 100 * std::sqrt(npe.squaredNorm() / static_cast<double>(half));
  };
  const double first = rms(run.rows[0].npe.head(half)), last = rms(run.rows[0].npe.tail(half));
  EXPECT_NEAR(ml.y.second, std::max(first, last), 1e-9);
  // the bounds of the columns are 1, 2 and 3 %
  const ShownSeries& bound = SeriesNamed(plot, "Cramér-Rao bound (rms)");
  EXPECT_NEAR(bound.y.first, std::sqrt(14), 1e-9);
  EXPECT_TRUE(Writes(figure, "torque noise (N·m)"));
  EXPECT_THAT(figure.finding, HasSubstr("from the first rung of torque noise to the last"));
}

/// Traces whose medians fall evenly and whose quartiles lie 20 % about them: of three realizations.
RunRow FallingRow(const std::string& label, const std::string& identifier, int iterations,
                  const Eigen::Vector2d& npe, const Eigen::Vector2d& rmse) {
  const Eigen::Vector3d spread(0.6, 1, 1.4);
  RunRow row;
  row.label = label;
  row.identifier = identifier;
  row.trace.iteration = Eigen::VectorXd::LinSpaced(iterations, 1, iterations);
  row.trace.npe = spread * Eigen::RowVectorXd::LinSpaced(iterations, npe[0], npe[1]);
  row.trace.rmse = spread * Eigen::RowVectorXd::LinSpaced(iterations, rmse[0], rmse[1]);
  return row;
}

TEST(ErrorTraces, DrawMediansAndBandsOfQuartilesInTheIdentifiersColours) {
  RunView run;
  run.noise = 0.5;
  // the median of |x| of a normal x is 0.6745 standard deviations, and known to 1 % by draws
  run.bound_covariance = Eigen::MatrixXd::Constant(1, 1, std::pow(1.2 / 0.6745, 2));
  run.rows = {FallingRow("nominal-ls", "nominal-ls", 1, {1.2, 1.2}, {0.9, 0.9}),
              FallingRow("energy-als 50", "energy-als", 50, {1, 0.2}, {0.8, 0.55}),
              FallingRow("energy-als 500", "energy-als", 500, {1, 0.01}, {0.8, 0.5})};
  const Shown drawn = Look(*ErrorTraces(run));
  ASSERT_EQ(drawn.plots.size(), 2u);
  const ShownPlot& npe = PlotNamed(drawn, "Normalised parameter error");
  const ShownSeries& em = SeriesNamed(npe, "energy-als 500");
  EXPECT_EQ(em.hue, IdentifierHue("energy-als"));
  EXPECT_EQ(em.x, std::pair(1.0, 500.0));
  EXPECT_NEAR(em.y.first, 1, 1e-12) << "per cent";
  EXPECT_NEAR(em.y.second, 100, 1e-12);
  EXPECT_NEAR(SeriesNamed(npe, "median at the Cramér-Rao bound").y.first, 1.2, 0.04);
  EXPECT_EQ(SeriesNamed(npe, "nominal-ls").x, std::pair(1.0, 500.0)) << "a level";

  const ShownPlot& rmse = PlotNamed(drawn, "Root mean square error of the fit");
  EXPECT_EQ(SeriesNamed(rmse, "noise").y, std::pair(0.5, 0.5));
  EXPECT_NEAR(SeriesNamed(rmse, "energy-als 50").y.first, 0.55, 1e-12);
  EXPECT_NEAR(SeriesNamed(rmse, "energy-als 50").y.second, 0.8, 1e-12);

  // the band of energy-als 500 stands alone at its end: median 1 %, quartiles 0.8 and 1.2 %
  const auto band = std::ranges::find_if(npe.series, [](const ShownSeries& series) {
    return series.label.empty() && std::abs(series.y.first - 0.8) < 1e-9;
  });
  ASSERT_NE(band, npe.series.end());
  EXPECT_NEAR(band->y.second, 120, 1e-9);
  EXPECT_EQ(band->hue, Hue::vermilion);
}

TEST(ParameterTraces, ShowWhereMostRealizationsRunAndTheTruth) {
  RunView run = ExampleRun();
  const Figure figure = *ParameterTraces(run);
  const Shown drawn = Look(figure);
  const ShownPlot& plot = PlotNamed(drawn, "viscous, k_{v}");
  // starts are evenly between 5 1.5 and 5 2.5 times 0.95 at the first iteration
  const ShownSeries& band = SeriesNamed(plot, "middle 80 %");
  EXPECT_NEAR(band.y.second, 5 * (1 + 1.4 * std::exp(-0.05)), 0.02);
  EXPECT_EQ(SeriesNamed(plot, "truth").y, std::pair(5.0, 5.0));
  EXPECT_EQ(SeriesNamed(plot, "median").hue, IdentifierHue("energy-als"));
  EXPECT_EQ(drawn.plots.size(), 1u) << "thermal_pole is no parameter of the continuous truth";

  // few have a line each
  ParameterTrace& trace = run.rows[1].trace;
  trace.parameters[0] = trace.parameters[0].topRows(3).eval();
  const Shown few = Look(*ParameterTraces(run));
  EXPECT_EQ(SeriesNamed(PlotNamed(few, "viscous, k_{v}"), "realizations").points, 3 * 200);
}

TEST(AgreementBars, AreMediansOfTheRightNumbers) {
  RunView run = ExampleRun();
  const Shown apart = Look(*AgreementBars(run));
  ASSERT_EQ(apart.plots.size(), 4u) << "Fit and RMSE of each of two variants";
  EXPECT_EQ(apart.plots[2].title, "noise.torque 1 N·m: Fit");
  run.rungs = {};
  const Shown drawn = Look(*AgreementBars(run));
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
  const Figure figure = *IntervalCoverage(ExampleRun());
  const Shown drawn = Look(figure);
  const ShownSeries& shares = SeriesNamed(drawn.plots.at(0), "energy-ml");
  EXPECT_EQ(shares.points, 3);
  EXPECT_NEAR(shares.y.first, 95, 1e-9) << "38 of 40";
  EXPECT_TRUE(Writes(figure, "τ")) << "symbols";
}

TEST(ParameterPairs, HoldTheirEllipsesAndThatOfTheBound) {
  const Shown drawn = Look(*ParameterPairs(ExampleRun()));
  ASSERT_EQ(drawn.plots.size(), 3u);
  const ShownPlot& plot = drawn.plots[0];  // viscous, coulomb: deviations of 1 and 2 per cent
  const ShownSeries& bound = SeriesNamed(plot, "Cramér-Rao bound");
  // sqrt(chi^2 of 2 degrees at 95 %) = 2.4477; 121 points miss the tip by 1 - cos(1.5 deg) at most
  EXPECT_NEAR(bound.x.second, 2.4477, 0.001);
  EXPECT_NEAR(bound.y.second, 2 * 2.4477, 0.002);
  // 40 draws: their deviation is known to 11 %, three times that here
  EXPECT_NEAR(SeriesNamed(plot, "their 95 % ellipse").x.second, 2.4477, 0.9);
}

constexpr int kRealizations = 50;

/// Realization i, whose NPE is i; every second interval holds the truth, every tenth answer fails. The truth of the 45th
/// has another law, whose first parameter the others lack.
Realization Numbered(int i) {
  Result result;
  result.realization = i;
  result.status = i % 10 == 9 ? "not_converged" : "ok";
  const ParameterScore one{"coulomb", 15, 15.0 + i, true, i % 2 == 0, 0.5};
  result.metrics = Metrics{100, 1, 1, 0.5, 0.4, 95, 0.25};
  const auto npe = static_cast<double>(i);
  std::vector<ParameterScore> all{one};
  if (i == 45) all = {{"static", 20, 21, true, true, 0.5}, one};
  result.score = Score{all, all, npe, npe, 0.05, 0.05};
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

TEST(ReadRunView, DrawsAllOfAShortRunAndOneInSeveralOfALongOneAndCountsAll) {
  const RunView whole = ReadNumbered(kMostDrawn);
  EXPECT_EQ(whole.drawn_every, 1);
  EXPECT_EQ(whole.rows.at(0).npe, Eigen::VectorXd::LinSpaced(kRealizations, 0, kRealizations - 1));

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
  // a parameter of one law stands for itself
  const ParameterColumn& of_other = row.parameters.at(1);
  EXPECT_EQ(of_other.name, "static");
  EXPECT_EQ(of_other.intervals, 1);
  EXPECT_EQ(of_other.estimate[9], 21);
  EXPECT_TRUE(of_other.estimate.head(9).array().isNaN().all());
}

}  // namespace
}  // namespace warmjoint::figures
