#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "sim/plant/plant.h"
#include "tests/support/table1.h"

namespace warmjoint {
namespace {

Simulation Simulate(const Scenario& scenario) { return MakePlant(scenario)->Run(0); }

/// What the disturbances add to the torque of Table I.
Eigen::ArrayXd Added(const Disturbances& disturbances) {
  Scenario scenario = test::Table1();
  const Eigen::VectorXd plain = Simulate(scenario).measurements.torque;
  scenario.disturbances = disturbances;
  return Simulate(scenario).measurements.torque - plain;
}

TEST(Disturbances, ColouredNoiseHasItsDeviationAndMemory) {
  Disturbances disturbances;
  disturbances.coloured_noise = {2, 10};
  const Eigen::ArrayXd noise = Added(disturbances);
  const double n = static_cast<double>(noise.size());

  // AR(1) with a = exp(-1/10): variances of sample moments grow by (1 + a^2) / (1 - a^2); 5 sd
  const double a = std::exp(-0.1);
  const double bound = 5 * std::sqrt(2 * (1 + a * a) / (1 - a * a) / n);
  EXPECT_NEAR(noise.square().mean() / 4, 1, bound);
  const Eigen::Index last = noise.size() - 1;
  EXPECT_NEAR((noise.head(last) * noise.tail(last)).mean() / 4, a, bound);

  // what remains of the memory is white: innovations have deviation 2 sqrt(1 - a^2)
  const Eigen::ArrayXd fresh = noise.tail(last) - a * noise.head(last);
  EXPECT_NEAR(fresh.square().mean() / (4 * (1 - a * a)), 1, 5 * std::sqrt(2 / n));
}

TEST(Disturbances, ColouredNoiseJoinsTheKnownNoise) {
  Scenario scenario = test::Table1();
  scenario.noise.torque = 3;
  scenario.disturbances.coloured_noise = {4, 10};
  EXPECT_DOUBLE_EQ(Simulate(scenario).truth.torque_noise, 5);
}

TEST(Disturbances, UnevenNoiseGrowsWithFrictionAndSpeed) {
  Disturbances disturbances;
  disturbances.uneven_noise = {0.03, 0.6};
  const Eigen::ArrayXd noise = Added(disturbances);
  const Truth truth = Simulate(test::Table1()).truth;
  const Eigen::ArrayXd deviation =
      0.03 * truth.force.array().abs() + 0.6 * truth.velocity.array().abs();
  // standardised, the mean square of n normal numbers has a standard deviation of sqrt(2 / n); 5 sd
  const double bound = 5 * std::sqrt(2.0 / static_cast<double>(noise.size()));
  EXPECT_NEAR((noise / deviation).square().mean(), 1, bound);
  EXPECT_EQ(Simulate(test::Table1()).truth.torque_noise, truth.torque_noise);
}

TEST(Disturbances, LostSamplesAreGoneByChanceButTheEnds) {
  Scenario scenario = test::Table1();
  const Simulation whole = Simulate(scenario);
  scenario.disturbances.faults.lost_samples.fraction = 0.1;
  const Simulation left = Simulate(scenario);
  // of 3600 samples 360 with sd sqrt(3600 * 0.09) = 18
  EXPECT_NEAR(static_cast<double>(left.measurements.size()), 3240, 5 * 18);
  EXPECT_EQ(left.measurements.time[0], whole.measurements.time[0]);
  EXPECT_EQ(left.measurements.time.tail(1), whole.measurements.time.tail(1));
  EXPECT_EQ(left.truth.energy.size(), left.measurements.size());
  for (Eigen::Index i = 0; i < left.measurements.size(); ++i) {
    const auto n = static_cast<Eigen::Index>(std::lround(left.measurements.time[i]));
    EXPECT_EQ(left.measurements.torque[i], whole.measurements.torque[n]);
    EXPECT_EQ(left.truth.energy[i], whole.truth.energy[n]);
  }
}

TEST(Disturbances, PeriodicTorqueIsASineOfTime) {
  Disturbances disturbances;
  disturbances.periodic_torque = {0.7, 40};
  const Eigen::ArrayXd torque = Added(disturbances);
  // 3600 s hold 90 whole periods: mean square of a sine is a half, and it repeats
  EXPECT_NEAR(torque.square().mean(), 0.7 * 0.7 / 2, 1e-12);
  EXPECT_LT((torque.head(3560) - torque.tail(3560)).abs().maxCoeff(), 1e-11);
}

TEST(Disturbances, OutliersHitTheirShareOfTheSamples) {
  Disturbances disturbances;
  disturbances.outliers = {0.1, 5};
  const Eigen::ArrayXd torque = Added(disturbances);
  // of 3600 samples 360 with sd sqrt(3600 * 0.09) = 18; their variance with sd sqrt(2 / 360)
  const double hit = static_cast<double>((torque != 0).count());
  EXPECT_NEAR(hit, 360, 5 * 18);
  EXPECT_NEAR(torque.square().sum() / hit / 25, 1, 5 * std::sqrt(2 / hit));
}

TEST(Disturbances, GravityFollowsThePosition) {
  Scenario scenario = test::Table1();
  scenario.noise.torque = 0;
  scenario.disturbances.gravity = {5, -2};
  const Simulation recording = Simulate(scenario);
  const Measurements& log = recording.measurements;
  for (Eigen::Index i = 0; i < log.size(); ++i) {
    const double gravity = 5 * std::sin(log.position[i]) - 2 * std::cos(log.position[i]);
    EXPECT_NEAR(log.torque[i], recording.truth.force[i] + gravity, 1e-12);
  }
}

TEST(Disturbances, AmbientTemperatureMovesTheLevel) {
  Scenario scenario = test::Table1();
  scenario.friction.thermal.reset();
  scenario.disturbances.ambient_drift = {2, 3600};
  const Simulation recording = Simulate(scenario);
  const double v = recording.truth.velocity[900];
  EXPECT_NEAR(std::abs(recording.truth.force[900]), 5 * std::abs(v) + 15 + 2, 1e-12);
}

TEST(Disturbances, LoadRaisesTheLevelAndIsLogged) {
  Scenario scenario = test::Table1();
  scenario.friction.thermal.reset();
  scenario.disturbances.load_change = {-10, 0.1, 100};
  const Simulation recording = Simulate(scenario);
  ASSERT_TRUE(recording.measurements.load);
  const Eigen::ArrayXd cold = 5 * recording.truth.velocity.array().abs() + 15;
  for (Eigen::Index i = 0; i < 200; ++i) {
    const double load = i % 100 < 50 ? 0 : -10;
    EXPECT_EQ((*recording.measurements.load)[i], load);
    EXPECT_NEAR(std::abs(recording.truth.force[i]), cold[i] - 0.1 * load, 1e-12);
  }
}

TEST(Disturbances, TwoEqualHeatsAreOneOfTwiceTheGain) {
  Scenario once = test::Table1();
  Scenario twice = test::Table1();
  twice.friction.thermal = Thermal{-1.5, 600};
  twice.disturbances.second_heat = Thermal{-1.5, 600};
  // two recursions of 3600 steps round at 1e-12 of the level
  EXPECT_LT((Simulate(once).truth.energy - Simulate(twice).truth.energy).cwiseAbs().maxCoeff(),
            1e-10);
}

/// Table I with what `set` sets, without noise of the torque.
Simulation Disturbed(const std::function<void(Disturbances&)>& set) {
  Scenario scenario = test::Table1();
  scenario.noise.torque = 0;
  set(scenario.disturbances);
  return Simulate(scenario);
}

TEST(Disturbances, ALagFollowsTheFrictionByItsTimeConstant) {
  const auto [log, truth, drive] = Disturbed([](Disturbances& set) { set.torque_lag = {2}; });
  EXPECT_EQ(log.torque[0], truth.force[0]);
  for (Eigen::Index i = 1; i < log.size(); ++i) {
    const double share = -std::expm1(-0.5);
    EXPECT_NEAR(log.torque[i], log.torque[i - 1] + share * (truth.force[i - 1] - log.torque[i - 1]),
                1e-12);
  }
}

TEST(Disturbances, AFilterOfTheVelocityLeavesPositionAndTorque) {
  const auto [log, truth, drive] = Disturbed([](Disturbances& set) { set.velocity_filter = {2}; });
  const auto [plain, same, other_drive] = Disturbed([](Disturbances&) {});
  EXPECT_EQ(log.position, plain.position);
  EXPECT_EQ(log.torque, plain.torque);
  EXPECT_EQ(log.velocity[0], plain.velocity[0]);
  EXPECT_NEAR(log.velocity[21],
              plain.velocity[0] + -std::expm1(-0.5) * (plain.velocity[20] - plain.velocity[0]),
              1e-12);
}

TEST(Disturbances, PositionsAreLateOrCoarse) {
  const auto [plain, truth, drive] = Disturbed([](Disturbances&) {});
  const auto [late, same, other_drive] =
      Disturbed([](Disturbances& set) { set.stale_position = {1}; });
  const Eigen::Index n = plain.size() - 1;
  EXPECT_EQ(late.position.tail(n), plain.position.head(n));
  const auto [coarse, also, third_drive] =
      Disturbed([](Disturbances& set) { set.encoder = {0.05}; });
  EXPECT_LE((coarse.position - plain.position).cwiseAbs().maxCoeff(), 0.025 + 1e-12);
}

TEST(Disturbances, ALogMayHaveNoVelocity) {
  const auto [log, truth, drive] =
      Disturbed([](Disturbances& set) { set.without_velocity = true; });
  EXPECT_EQ(log.velocity.size(), 0);
  EXPECT_EQ(truth.velocity.size(), log.size());
}

TEST(Disturbances, HiddenForcesFollowTheMotionAndNotItsSensor) {
  for (const PlantKind plant : {PlantKind::ideal, PlantKind::mujoco}) {
    Scenario scenario = test::Table1();
    scenario.plant = plant;
    scenario.robot = "rotary";
    scenario.joint = "hinge";
    scenario.duration = 100;
    HiddenForces& hidden = scenario.disturbances.hidden;
    hidden.backlash = {5, 0.3};
    hidden.hysteresis = {3, 0.5};
    hidden.ripple = {1, 1.3};
    hidden.spring = {0.5};
    const Simulation exact = Simulate(scenario);
    scenario.noise.position = 0.02;
    const Simulation noisy = Simulate(scenario);
    EXPECT_NE(noisy.measurements.position, exact.measurements.position);
    EXPECT_EQ(noisy.measurements.torque, exact.measurements.torque);
  }
}

TEST(Disturbances, FrictionThatNoModelKnowsOpposesTheMotion) {
  const auto [plain, truth, drive] = Disturbed([](Disturbances&) {});
  const Eigen::ArrayXd sign = truth.velocity.array().sign();
  const auto added = [&](const std::function<void(Disturbances&)>& set) -> Eigen::ArrayXd {
    return (Disturbed(set).measurements.torque - plain.torque).array() * sign;
  };
  const Eigen::ArrayXd parity = added([](Disturbances& set) { set.hold_parity = {1}; });
  EXPECT_NEAR(parity[10], 0, 1e-12);
  EXPECT_NEAR(parity[30], 1, 1e-12);
  EXPECT_NEAR(parity[50], 0, 1e-12);
  const Eigen::ArrayXd step = added([](Disturbances& set) { set.step_in_time = {-3, 1800}; });
  EXPECT_NEAR(step[1799], 0, 1e-12);
  EXPECT_NEAR(step[1800], -3, 1e-12);
  const Eigen::ArrayXd run_in = added([](Disturbances& set) { set.run_in = {2, 600}; });
  EXPECT_NEAR(run_in[600], 2 * std::exp(-1), 1e-12);
}

}  // namespace
}  // namespace warmjoint
