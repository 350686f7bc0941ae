// Maps of an answer: their shape, and the friction at speeds.
#include <gtest/gtest.h>
#include <warmjoint/prepared_log.h>

#include <cmath>
#include <numbers>

#include "identification/answer/identify.h"
#include "identification/forward/log_trajectory.h"
#include "identification/holdout/hold_out.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/maps/energy_ml_maps.h"
#include "identification/maps/map_options.h"
#include "tests/support/judging.h"
#include "tests/support/travelling.h"

namespace warmjoint {
namespace {

Estimate Identified(const PreparedLog& log) {
  return test::Fitted("position-ridge", log, {{"kernels", "20"}, {"width", "1"}});
}

/// A joint whose level varies over its position by 0.3 N.m, and its answer.
struct Rippled {
  Friction truth{"viscous_coulomb", {{"viscous", 0.5}, {"coulomb", 2}}, {}, 0, 100};
  Measurements log;
  Estimate estimate;

  explicit Rippled(std::uint64_t seed) {
    truth.maps = {test::PositionLevel(1, 0.3)};
    log = test::Record(0.1, test::Travel(6000, 0.1, 1, {0.31, 0.57, 0.57, 0.83}),
                       Eigen::VectorXd::Zero(6000));
    log.position.array() -= 1;
    log.torque = PredictFriction(truth, LogSamples(log)).force;
    test::AddNoise(log, 0.1, 0, seed);
    estimate = Identified(Prepare(log));
  }

  /// What it brakes with at one speed, below 0 backwards, in the mean over its samples at that speed.
  double TruthAt(double speed) const {
    const LogView view = Prepare(log).constant_speed();
    const Eigen::VectorXd force = PredictFriction(truth, view.measurements).force;
    double sum = 0, count = 0;
    for (Eigen::Index i = 0; i < force.size(); ++i) {
      const double off = std::abs(view.measurements.velocity[i] - speed);
      if (!view.selection.keep[i] || off > 0.02 * std::abs(speed)) continue;
      sum += std::abs(force[i]);
      ++count;
    }
    return sum / count;
  }
};

TEST(FrictionAtSpeeds, HoldsWhatLawAndMapBrakeWith) {
  int held = 0, all = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Rippled rippled(seed);
    const auto& at_speeds = rippled.estimate.friction_at_speeds;
    ASSERT_EQ(at_speeds.size(), 6u) << rippled.estimate.message;
    for (const FrictionAtSpeed& one : at_speeds) {
      const double truth = rippled.TruthAt(one.speed);
      EXPECT_NEAR(one.value, truth, 0.02) << one.speed;
      EXPECT_EQ(one.speed_unit + ", " + one.unit, "rad/s, N.m");
      // every so manieth of 1500 places has a mean of their level that is its own to 0.001
      held += one.interval95[0] <= truth + 0.001 && truth - 0.001 <= one.interval95[1];
      ++all;
    }
    // known to the noise of the 1500 samples at this speed, where the constant itself is not known at all
    EXPECT_LT(at_speeds[1].std, 2 * 0.1 / std::sqrt(1500));
    EXPECT_FALSE(rippled.estimate.Find("coulomb")->interval95);

    // a low speed, the median and a high one of each direction
    EXPECT_NEAR(at_speeds[0].speed, 0.31, 0.01);
    EXPECT_NEAR(at_speeds[2].speed, 0.83, 0.01);
    EXPECT_GT(at_speeds[1].speed, 0.31);
    EXPECT_LT(at_speeds[1].speed, 0.83);
    EXPECT_NEAR(at_speeds[3].speed, -0.31, 0.01);
  }
  EXPECT_GT(held, 0.9 * all);
}

TEST(FrictionAtSpeeds, IsThatOfThePlacesWhereTheJointMovedSo) {
  // slow below 0.5 rad and fast above, to and fro: nothing tells the slope from the map
  const Eigen::Index n = 8000;
  Eigen::VectorXd velocity(n);
  double position = 0, direction = 1;
  for (Eigen::Index i = 0; i < n; ++i) {
    velocity[i] = direction * (position < 0.5 ? 0.2 : 1);
    position += 0.01 * velocity[i];
    if (position > 1 || position < 0) direction = -direction;
  }
  Measurements m = test::Record(0.01, velocity, velocity);
  m.torque = 5 * velocity.array() + 15 * velocity.array().sign();
  test::AddNoise(m, 0.1, 0, 1);
  Selection selection = Prepare(m).constant_speed().selection;
  selection.keep = selection.keep && (m.position.array() - 0.5).abs() > 0.15;
  const Estimate estimate = Identified(Prepare(m, selection));
  ASSERT_EQ(estimate.friction_at_speeds.size(), 4u) << estimate.message;
  for (const FrictionAtSpeed& one : estimate.friction_at_speeds) {
    EXPECT_NEAR(one.value, 15 + 5 * std::abs(one.speed), 0.05);
    EXPECT_LT(one.std, 0.02);
  }
  EXPECT_FALSE(estimate.Find("viscous")->interval95);
}

constexpr double kTurn = 2 * std::numbers::pi;  // rad
constexpr double kGear = 4.8332;

TEST(MotorMaps, LeaveTheHeatToTheWarmingOfAJointThatWanders) {
  Friction friction = test::TableOne();
  friction.gear = kGear;
  FrictionMap ripple{{{MapQuantity::motor_position, CircleAxis(kTurn, 12)}},
                     KernelKind::normalised,
                     {},
                     MapFactor::direction};
  for (int i = 0; i < 12; ++i) ripple.weights.push_back(0.7 * std::cos(kTurn * i / 12));
  friction.maps = {ripple};
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Measurements m = test::RecordHour(friction, seed);
    m.gear = kGear;
    const Estimate estimate = test::Answer("energy-ml", m, {{"position", "motor"}});
    ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
    // 4 of its own standard deviations, which a map that follows the wandering makes ten times as large
    SCOPED_TRACE(seed);
    test::ExpectTold(estimate, {{"thermal_gain", -3}, {"thermal_time_constant", 600}}, 4, 0.02);
  }
}

/// A log of ten minutes of a joint whose level varies in so many cycles over its travel.
Measurements Wavy(double cycles, const std::vector<double>& speeds, std::uint64_t seed) {
  const Eigen::VectorXd velocity = test::Travel(12000, 0.05, 1, speeds);
  Measurements m = test::Record(0.05, velocity, velocity);
  m.position.array() -= 1;
  m.torque =
      5 * velocity.array() +
      velocity.array().sign() * (15 + (std::numbers::pi * cycles * m.position.array()).sin());
  test::AddNoise(m, 0.5, 0, seed);
  return m;
}

struct Across {
  size_t kernels = 0;
  double width = 0;  // of them in spacings
  double error = 0;  // mean square on the other file
};

Across FitAndTry(const PreparedLog& log, const PreparedLog& other,
                 const std::map<std::string, std::string>& given) {
  const Identifier& identifier = FindIdentifier("position-ridge");
  const Options options = identifier.options.Read(given);
  const Fit fit = identifier.fit({log, options, {}});
  const GaussianAxis& axis = fit.model.friction.maps.at(0).axes[0].kernels;
  const double rmse = HoldOut(identifier, fit, other).metrics->rmse;
  return {axis.size(), axis.width / (axis.centres[1] - axis.centres[0]), rmse * rmse};
}

TEST(PositionMaps, TheShapeThatIsChosenIsAsGoodOnAnotherFileAsHalfItsKernels) {
  size_t most = 0;
  for (const double cycles : {0.5, 2.0, 8.0, 30.0}) {
    double chosen = 0, half = 0;
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      const PreparedLog log = Prepare(Wavy(cycles, {0.2, 0.5, 0.9}, seed));
      const PreparedLog other = Prepare(Wavy(cycles, {0.3, 0.7, 0.4}, 100 + seed));
      const Across own = FitAndTry(log, other, {});
      const Across fewer = FitAndTry(
          log, other,
          {{"kernels", std::to_string(own.kernels / 2)}, {"width", std::to_string(own.width)}});
      chosen += own.error;
      half += fewer.error;
      most = std::max(most, own.kernels);
    }
    // a mean square of 48,000 samples of noise is known to 0.7 %
    EXPECT_LT(chosen, 1.01 * half) << cycles;
  }
  EXPECT_GT(most, 40u) << "30 cycles need more than 60 kernels";
}

}  // namespace
}  // namespace warmjoint
