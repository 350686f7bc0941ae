// What pictures read of a recording: of motion of any kind, and of currents.
#include "tools/report/figures/fit_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/prepared_log.h>

#include "identification/answer/identify.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/preparation/moving_view.h"
#include "models/foundation/low_pass.h"
#include "tests/support/excited_recording.h"
#include "tests/tools/report/look.h"
#include "tests/tools/report/warm_recording.h"
#include "tools/report/estimate/estimate_figures.h"
#include "tools/report/figures/fit_page.h"
#include "tools/report/figures/predicted.h"

namespace warmjoint::report {
namespace {

using ::testing::HasSubstr;

struct Identified {
  PreparedLog log;
  Estimate estimate;
};

Identified Identify(const Measurements& m, const std::map<std::string, std::string>& given) {
  const Identifier& identifier = FindIdentifier("energy-ml");
  PreparedLog log = Prepare(m);
  Estimate estimate = IdentifyAndJudge(identifier, {log, identifier.options.Read(given), {}});
  return {std::move(log), std::move(estimate)};
}

Friction Warm() {
  Friction friction = test::TableOne();
  friction.thermal->time_constant = 100;
  return friction;
}

TEST(FitView, OfAnyMotionFitsFrictionGravityAndInertia) {
  const auto [log, estimate] = Identify(test::Excited(Warm(), 12000, 4), {{"gravity", "sincos"}});
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
  const Measurements& m = MovingView(log).measurements;
  const Eigen::VectorXd rigid =
      estimate.Find("inertia")->value * *m.acceleration + estimate.gravity->Torque(m.position);
  EXPECT_LT((view.rigid - rigid).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((view.torque + view.rigid - m.torque).cwiseAbs().maxCoeff(), 1e-12);

  const std::optional<Figure> predicted = MakePredicted(view);
  ASSERT_TRUE(predicted);
  const auto& scatter =
      std::get<Scatter>(std::get<Plot>(predicted->panels[0].content).series[0].shape);
  EXPECT_GT(scatter.y.maxCoeff(), view.fitted.maxCoeff() + 1) << "the fitted torque has all parts";
  for (const EstimateFigure& one : EstimateFigures()) {
    SCOPED_TRACE(one.name);
    if (const auto figure = one.make({estimate, m, view, std::nullopt})) DrawLight(*figure);
  }
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
  const auto [log, estimate] = Identify(m, {});
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  const FitView view = MakeFitView(log, estimate);
  int figures = 0;
  for (const EstimateFigure& one : EstimateFigures()) {
    const auto figure = one.make({estimate, m, view, std::nullopt});
    if (!figure) continue;
    SCOPED_TRACE(one.name);
    ++figures;
    const std::string words = figure->subtitle + figure->finding + AxesOf(*figure);
    EXPECT_EQ(words.find("N·m"), std::string::npos) << words;
    EXPECT_EQ(words.find("N.m"), std::string::npos) << words;
    EXPECT_THAT(words, testing::AnyOf(HasSubstr("(A)"), HasSubstr(" A"))) << words;
    DrawLight(*figure);
  }
  EXPECT_GE(figures, 8);
}

TEST(FitView, ShowsTheFitBehindALagOfTheTorque) {
  constexpr double lag = 3;  // s
  WarmRecording warm;
  const FitView plain = MakeFitView(warm.measurements, warm.selection, warm.estimate);
  Measurements& m = warm.measurements;
  m.torque = LowPass(m.time, plain.fitted, lag);
  EXPECT_GT(Residuals(MakeFitView(m, warm.selection, warm.estimate)).norm(), 1);
  warm.estimate.parameters.push_back({"torque_lag", lag, "s", {}, {}});
  EXPECT_LT(Residuals(MakeFitView(m, warm.selection, warm.estimate)).norm(), 1e-9);
}

}  // namespace
}  // namespace warmjoint::report
