#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/prepared_log.h>

#include <Eigen/LU>

#include "models/foundation/low_pass.h"
#include "models/recording/measurements.h"
#include "tests/support/judging.h"
#include "tests/support/warm_recording.h"
#include "tests/tools/figures/look.h"
#include "tests/tools/figures/warm_recording.h"
#include "tools/figures/estimate_figures.h"
#include "tools/figures/fit_panels.h"
#include "tools/figures/fit_view.h"
#include "tools/figures/friction_spread.h"

namespace warmjoint::figures {
namespace {

using ::testing::HasSubstr;

TEST(FitPage, TellsTheStoryOfAWarmFit) {
  const WarmRecording warm;
  const Shown drawn = Look(MakeFitPage(warm.View()));
  EXPECT_EQ(drawn.plots.size(), 10u);

  // data and fit are where they belong
  const ShownPlot& level = PlotNamed(drawn, "Level of friction over time");
  EXPECT_EQ(SeriesNamed(level, "fit").hue, Hue::blue);
  EXPECT_NEAR(SeriesNamed(level, "measured").x.second, 20, 0.1) << "minutes";
  const ShownPlot& curve = PlotNamed(drawn, "Friction over velocity");
  EXPECT_GT(SeriesNamed(curve, "fit, cold").y.second, SeriesNamed(curve, "fit, warmest").y.second);

  // E starts at 0 and falls to what the prediction says
  const ShownSeries& energy = SeriesNamed(PlotNamed(drawn, "Warm-up"), "E");
  EXPECT_EQ(energy.y.second, 0);
  EXPECT_NEAR(energy.y.first, warm.prediction.energy.minCoeff(), 1e-9);
}

TEST(FitPage, ExplainsWhyThereIsNoFit) {
  WarmRecording warm;
  warm.estimate = {};
  warm.estimate.identifier = "nominal-ls";
  warm.estimate.status = Status::not_identifiable;
  warm.estimate.message = "one speed alone";
  const FitView view = warm.View();
  std::string text;
  for (const Words::Paragraph& one : VerdictOf(view).paragraphs) text += one.text + "\n";
  EXPECT_THAT(text, HasSubstr("there are no numbers to use.\nOne speed alone."));
  Look(MakeFitPage(view));
}

/// Three kernels over position with these weights.
FrictionMap ThreeKernels(const std::vector<double>& weights) {
  FrictionMap map;
  map.axes = {{MapQuantity::position, EvenAxis(-10, 10, 3)}};
  map.weights = weights;
  return map;
}

TEST(FrictionCurve, HasNoBandWhereMapsCarryPartOfTheFriction) {
  WarmRecording warm;
  const auto bands = [&] {
    const Plot plot = FrictionCurve(warm.View());
    return std::count_if(plot.series.begin(), plot.series.end(), [](const Series& series) {
      return std::holds_alternative<Band>(series.shape);
    });
  };
  EXPECT_EQ(bands(), 4) << "cold and warm, either way";
  warm.estimate.friction->maps = {ThreeKernels({0.1, 0, -0.1})};
  EXPECT_EQ(bands(), 0);
}

TEST(FrictionCurve, RunsThroughTheDataWhereMapsCarryAConstant) {
  WarmRecording warm;
  warm.estimate.friction->maps = {ThreeKernels({4, 4, 4})};
  warm.estimate.friction->parameters["coulomb"] = 11;
  const Plot plot = FrictionCurve(warm.View());
  // 11 + 5 v of the law and 4 of the map, forwards at the fastest
  for (const Series& series : plot.series) {
    if (series.label != "fit, mean at each speed, cold") continue;
    const Line& line = std::get<Line>(series.shape);
    EXPECT_NEAR(line.y.tail(1)[0], 15 + 5 * line.x.tail(1)[0], 0.01);
    return;
  }
  FAIL() << "no curve";
}

TEST(FitPage, ShowsAVoidFitWithThePanelThatDecided) {
  WarmRecording warm;
  warm.estimate.status = Status::inadequate_model;
  Diagnostic direction;
  direction.test = "direction";
  direction.made = direction.rejected = true;
  warm.estimate.diagnostics = {direction};
  const Figure page = MakeFitPage(warm.View());
  int framed = 0;
  for (const Panel& panel : page.panels) {
    if (!panel.frame) continue;
    ++framed;
    EXPECT_EQ(panel.title, "Residuals over velocity: decided by direction");
    EXPECT_EQ(*panel.frame, Hue::vermilion);
  }
  EXPECT_EQ(framed, 1);
  const Shown drawn = Look(page);
  EXPECT_GT(SeriesNamed(PlotNamed(drawn, "Level of friction over time"), "fit (void)").points, 100);
  for (const Series& series : FrictionCurve(warm.View()).series) {
    const auto* line = std::get_if<Line>(&series.shape);
    EXPECT_TRUE(!line || line->dash == Dash::dashed);
  }
}

TEST(FrictionSpread, HasTheFrictionsShareOfTheCovariance) {
  WarmRecording warm;
  warm.estimate.friction->thermal.reset();
  Eigen::Matrix3d matrix;
  matrix << 4, 0.5, 1, 0.5, 9, 2, 1, 2, 16;
  warm.estimate.covariance = ParameterCovariance{{"coulomb", "gravity_sine", "viscous"}, matrix};
  // the interval of coulomb reaches as far as noise has it, that of viscous twice as far
  for (EstimatedParameter& one : warm.estimate.parameters) {
    const double half = 1.96 * (one.name == "coulomb" ? 2 : 2 * 4);
    one.interval95 = {{one.value - half, one.value + half}};
  }
  const FrictionSpread spread = SpreadOf(warm.estimate);
  ASSERT_EQ(spread.names, (std::vector<std::string>{"coulomb", "viscous"}));
  EXPECT_TRUE(spread.covariance.isApprox(Eigen::Matrix2d{{4, 2}, {2, 64}}));

  // the deviation of F at v = 0.5
  const auto predict = [](const Friction& friction) {
    const double force =
        friction.parameters.at("viscous") * 0.5 + friction.parameters.at("coulomb");
    return Eigen::VectorXd(Eigen::VectorXd::Constant(1, force));
  };
  const Eigen::Vector2d row(1, 0.5);
  EXPECT_NEAR(SpreadOfPrediction(spread, *warm.estimate.friction, predict)[0],
              std::sqrt(row.dot(spread.covariance * row)), 1e-9);
}

TEST(FitView, OfAnyMotionFitsFrictionGravityAndInertia) {
  Friction warm = test::TableOne();
  warm.thermal->time_constant = 100;
  const PreparedLog log = Prepare(test::Excited(warm, 12000, 4));
  const Estimate estimate =
      test::Answer("energy-ml", log, {{"gravity", "sincos"}, {"torque_delay", "none"}});
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  ASSERT_TRUE(estimate.Find("inertia"));
  const FitView view = MakeFitView(log, estimate);
  EXPECT_TRUE(IsOfAnyMotion(view));

  // the residual that is shown is that of the fit
  const Eigen::VectorXd residuals = Residuals(view);
  ASSERT_EQ(residuals.size(), estimate.metrics->n);
  EXPECT_NEAR(std::sqrt(residuals.squaredNorm() / static_cast<double>(residuals.size())),
              estimate.metrics->rmse, 1e-9);
  // and what is taken off is gravity and inertia
  const LogSamples& m = log.moving().measurements;
  const Eigen::VectorXd rigid =
      estimate.Find("inertia")->value * *m.acceleration + estimate.gravity->Torque(m.position);
  EXPECT_LT((view.rigid - rigid).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((view.torque + view.rigid - m.torque).cwiseAbs().maxCoeff(), 1e-12);

  const std::optional<Figure> predicted = MakePredicted(view);
  ASSERT_TRUE(predicted);
  const auto& scatter =
      std::get<Scatter>(std::get<Plot>(predicted->panels[0].content).series[0].shape);
  EXPECT_GT(scatter.y.maxCoeff(), view.fitted.maxCoeff() + 1) << "the fitted torque has all parts";
  LookAtAll(EstimateFigures(), EstimateView{estimate, m, view, std::nullopt});
}

/// The labels of all axes of a figure, one behind the other.
std::string AxesOf(const Figure& figure) {
  std::string labels;
  for (const Panel& panel : figure.panels) {
    if (const Plot* plot = std::get_if<Plot>(&panel.content)) {
      labels += plot->x.label + "|" + plot->y.label + "|";
    }
  }
  return labels;
}

TEST(FitView, OfACurrentSaysAmperesEverywhere) {
  Measurements m =
      test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(3600, 1), 0.3, 1);
  m.torque_unit = "A";
  const PreparedLog log = Prepare(m);
  const Estimate estimate = test::Answer("energy-ml", log);
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  const FitView view = MakeFitView(log, estimate);
  int figures = 0;
  for (const EstimateFigure& one : EstimateFigures()) {
    const auto figure = one.make({estimate, LogSamples(m), view, std::nullopt});
    if (!figure) continue;
    SCOPED_TRACE(one.name);
    ++figures;
    const std::string words = figure->subtitle + figure->finding + AxesOf(*figure);
    EXPECT_EQ(words.find("N·m"), std::string::npos) << words;
    EXPECT_EQ(words.find("N.m"), std::string::npos) << words;
    EXPECT_THAT(words, testing::AnyOf(HasSubstr("(A)"), HasSubstr(" A"))) << words;
    Look(*figure);
  }
  EXPECT_GE(figures, 8);
}

TEST(FitView, ShowsTheFitBehindALagOfTheTorque) {
  constexpr double lag = 3;  // s
  WarmRecording warm;
  const FitView plain = warm.View();
  Measurements& m = warm.measurements;
  m.torque = LowPass(m.time, plain.fitted, lag);
  EXPECT_GT(Residuals(warm.View()).norm(), 1);
  warm.estimate.parameters.push_back({"torque_lag", lag, "s", {}, {}});
  EXPECT_LT(Residuals(warm.View()).norm(), 1e-9);
}

}  // namespace
}  // namespace warmjoint::figures
