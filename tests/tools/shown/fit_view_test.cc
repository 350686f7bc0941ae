// What is worked out of a log and its estimate for pictures and pages.
#include "tools/shown/fit_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/prepared_log.h>

#include <Eigen/LU>
#include <cmath>

#include "identification/answer/identify.h"
#include "identification/estimate.h"
#include "identification/holdout/hold_out.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/uncertainty/tails.h"
#include "models/foundation/low_pass.h"
#include "tests/support/judging.h"
#include "tests/support/warm_recording.h"
#include "tests/tools/shown/warm_recording.h"
#include "tools/shown/estimate_view.h"
#include "tools/shown/friction_spread.h"

namespace warmjoint::shown {
namespace {

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

TEST(FitView, ShowsTheSamplesThatTheFitRestsOn) {
  // 3 N.m that fade within seconds of each change of speed, every 20 s
  Measurements m = test::RecordHour(test::TableOne(), 3);
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    m.torque[i] += std::copysign(3 * std::exp(-std::fmod(m.time[i], 20) / 2), m.velocity[i]);
  }
  const PreparedLog log = Prepare(m);
  const Estimate answer = test::Answer("energy-ml", log);
  ASSERT_EQ(answer.status, Status::ok) << answer.message;
  ASSERT_TRUE(answer.settling);
  EXPECT_GT(answer.settling->after, 2);
  EXPECT_EQ(answer.settling->before, 0);

  // by the file alone
  const Estimate estimate = EstimateFrom({EstimateToTree(answer), "estimate.json"});
  const Eigen::VectorXd residuals = Residuals(MakeFitView(log, estimate));
  ASSERT_EQ(residuals.size(), estimate.metrics->n);
  EXPECT_NEAR(std::sqrt(residuals.squaredNorm() / static_cast<double>(residuals.size())),
              estimate.metrics->rmse, 1e-9);
}

TEST(FitView, TellsFrictionAtARoundSpeedNearTheMedianWithItsDeviation) {
  const FitView view = WarmRecording().View();
  ASSERT_TRUE(view.at_speed);
  EXPECT_EQ(view.at_speed->speed, 0.5);
  EXPECT_NEAR(view.at_speed->cold, 15 + 5 * 0.5, 1e-12);
  EXPECT_LT((view.at_speed->force.array() - 17.5 - view.energy.array()).abs().maxCoeff(), 1e-12);
  // at first, without heat, as wide as the intervals of coulomb, 15 +- 0.2, and viscous, 5 +- 0.12, which are independent
  EXPECT_NEAR(kNormal95 * view.at_speed->deviation[0], std::hypot(0.2, 0.5 * 0.12), 1e-6);
}

TEST(EstimateView, ShowsTheFitOfARefusedEstimateWithItsOptions) {
  const PreparedLog log = Prepare(WarmRecording().measurements);
  // a law that knows no warming of a joint that warms, as its file holds it after a verdict
  const Estimate answer = test::Answer("nominal-ls", log, {{"law", "coulomb"}});
  const Estimate refused = EstimateFrom({EstimateToTree(answer), "estimate.json"});
  ASSERT_NE(refused.status, Status::ok);
  ASSERT_FALSE(refused.friction.has_value());
  const EstimateView view = ViewOwnRecording(refused, log);
  ASSERT_TRUE(view.fit->has_fit);
  EXPECT_EQ(view.estimate.friction->law, "coulomb");
  EXPECT_EQ(view.estimate.parameters.size(), 1u);
}

TEST(EstimateView, PredictsTheHeldOutSamplesByAFitThatHasNotSeenThem) {
  const PreparedLog log = Prepare(WarmRecording().measurements);
  const Identifier& identifier = FindIdentifier("energy-ml");
  const Options options = identifier.options.Read({});
  const IdentifierInput input{log, options, {}};
  Estimate estimate = IdentifyAndCheck(identifier, input);
  estimate.holdout = HoldOut(identifier, input, 0.3).metrics;
  const EstimateView view = ViewOwnRecording(estimate, log);
  ASSERT_TRUE(view.held_out.has_value());
  EXPECT_EQ(view.held_out->selection.count(), estimate.holdout->n);
  const double rmse = std::sqrt(Residuals(*view.held_out).array().square().mean());
  EXPECT_NEAR(rmse, estimate.holdout->rmse, 1e-9 * rmse) << "the same fit and the same samples";
  EXPECT_FALSE(MakeEstimateView(estimate, log).held_out.has_value()) << "of another recording";
}

}  // namespace
}  // namespace warmjoint::shown
