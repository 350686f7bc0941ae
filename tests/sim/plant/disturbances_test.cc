#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/plant/plant.h"
#include "tests/support/table1.h"

namespace warmjoint {
namespace {

Recording Simulate(const Scenario& scenario) { return MakePlant(scenario)->Run(0); }

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
  const Recording recording = Simulate(scenario);
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
  const Recording recording = Simulate(scenario);
  const double v = recording.truth.velocity[900];
  EXPECT_NEAR(std::abs(recording.truth.force[900]), 5 * std::abs(v) + 15 + 2, 1e-12);
}

TEST(Disturbances, LoadRaisesTheLevelAndIsLogged) {
  Scenario scenario = test::Table1();
  scenario.friction.thermal.reset();
  scenario.disturbances.load_change = {-10, 0.1, 100};
  const Recording recording = Simulate(scenario);
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

}  // namespace
}  // namespace warmjoint
