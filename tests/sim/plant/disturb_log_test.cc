// What disturbs a log: noise, forces that no model holds, poor sensors, clocks and files.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "sim/plant/plant.h"
#include "tests/support/table1.h"

namespace warmjoint {
namespace {

using Eigen::VectorXd;

Simulation Simulate(const Scenario& scenario) { return MakePlant(scenario)->Run(0); }

using Set = std::function<void(Disturbances&)>;

/// Table I with what `set` sets, and with this noise of the torque.
Simulation Disturbed(const Set& set, double noise = 0) {
  Scenario scenario = test::Table1();
  scenario.noise.torque = noise;
  set(scenario.disturbances);
  return Simulate(scenario);
}

/// What that adds to the torque.
Eigen::ArrayXd Added(const Set& set) {
  return Disturbed(set).measurements.torque - Disturbed([](Disturbances&) {}).measurements.torque;
}

TEST(Disturbances, ColouredNoiseHasItsDeviationAndMemory) {
  const Eigen::ArrayXd noise = Added([](auto& set) { set.coloured_noise = {2, 10}; });
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
  const auto coloured = [](Disturbances& set) { set.coloured_noise = {4, 10}; };
  EXPECT_DOUBLE_EQ(Disturbed(coloured, 3).truth.torque_noise, 5);
}

TEST(Disturbances, UnevenNoiseGrowsWithFrictionAndSpeed) {
  const Eigen::ArrayXd noise = Added([](auto& set) { set.uneven_noise = {0.03, 0.6}; });
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
  const Eigen::ArrayXd torque = Added([](auto& set) { set.periodic_torque = {0.7, 40}; });
  // 3600 s hold 90 whole periods: mean square of a sine is a half, and it repeats
  EXPECT_NEAR(torque.square().mean(), 0.7 * 0.7 / 2, 1e-12);
  EXPECT_LT((torque.head(3560) - torque.tail(3560)).abs().maxCoeff(), 1e-11);
}

TEST(Disturbances, OutliersHitTheirShareOfTheSamples) {
  const Eigen::ArrayXd torque = Added([](auto& set) { set.outliers = {0.1, 5}; });
  // of 3600 samples 360 with sd sqrt(3600 * 0.09) = 18; their variance with sd sqrt(2 / 360)
  const double hit = static_cast<double>((torque != 0).count());
  EXPECT_NEAR(hit, 360, 5 * 18);
  EXPECT_NEAR(torque.square().sum() / hit / 25, 1, 5 * std::sqrt(2 / hit));
}

TEST(Disturbances, GravityFollowsThePosition) {
  const Simulation disturbed = Disturbed([](auto& set) { set.gravity = {5, -2}; });
  const Measurements& log = disturbed.measurements;
  const Truth& truth = disturbed.truth;
  for (Eigen::Index i = 0; i < log.size(); ++i) {
    const double gravity = 5 * std::sin(log.position[i]) - 2 * std::cos(log.position[i]);
    EXPECT_NEAR(log.torque[i], truth.force[i] + gravity, 1e-12);
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

TEST(Disturbances, ALagFollowsTheFrictionByItsTimeConstant) {
  const Simulation disturbed = Disturbed([](Disturbances& set) { set.torque_lag = {2}; });
  const Measurements& log = disturbed.measurements;
  const Truth& truth = disturbed.truth;
  EXPECT_EQ(log.torque[0], truth.force[0]);
  for (Eigen::Index i = 1; i < log.size(); ++i) {
    const double share = -std::expm1(-0.5);
    EXPECT_NEAR(log.torque[i], log.torque[i - 1] + share * (truth.force[i - 1] - log.torque[i - 1]),
                1e-12);
  }
}

TEST(Disturbances, PoorSensorsOfTheMotionLeaveTheRestAsItIs) {
  const auto log = [](const Set& set) { return Disturbed(set).measurements; };
  const Measurements plain = log([](Disturbances&) {});
  const Measurements filtered = log([](Disturbances& set) { set.velocity_filter = {2}; });
  EXPECT_EQ(filtered.position, plain.position);
  EXPECT_EQ(filtered.torque, plain.torque);
  EXPECT_EQ(filtered.velocity[0], plain.velocity[0]);
  const double rise = -std::expm1(-0.5) * (plain.velocity[20] - plain.velocity[0]);
  EXPECT_NEAR(filtered.velocity[21], plain.velocity[0] + rise, 1e-12);
  const Measurements late = log([](Disturbances& set) { set.stale_position = {1}; });
  const Eigen::Index n = plain.size() - 1;
  EXPECT_EQ(late.position.tail(n), plain.position.head(n));
  const Measurements coarse = log([](Disturbances& set) { set.encoder = {0.05}; });
  EXPECT_LE((coarse.position - plain.position).cwiseAbs().maxCoeff(), 0.025 + 1e-12);
  const Simulation without = Disturbed([](Disturbances& set) { set.without_velocity = true; });
  EXPECT_EQ(without.measurements.velocity.size(), 0);
  EXPECT_EQ(without.truth.velocity.size(), without.measurements.size());
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
  const Truth truth = Disturbed([](Disturbances&) {}).truth;
  const auto along = [&](const Set& set) -> Eigen::ArrayXd {
    return Added(set) * truth.velocity.array().sign();
  };
  const Eigen::ArrayXd parity = along([](Disturbances& set) { set.hold_parity = {1}; });
  EXPECT_NEAR(parity[10], 0, 1e-12);
  EXPECT_NEAR(parity[30], 1, 1e-12);
  EXPECT_NEAR(parity[50], 0, 1e-12);
  const Eigen::ArrayXd step = along([](Disturbances& set) { set.step_in_time = {-3, 1800}; });
  EXPECT_NEAR(step[1799], 0, 1e-12);
  EXPECT_NEAR(step[1800], -3, 1e-12);
  EXPECT_NEAR(along([](Disturbances& set) {
                set.run_in = {2, 600};
              })[600],
              2 * std::exp(-1), 1e-12);
}

constexpr double kSampleStep = 0.01;  // s

/// To and fro at 0.5 rad/s, 4 s each way.
struct ToAndFro {
  VectorXd time = VectorXd::LinSpaced(1601, 0, 16);
  VectorXd velocity, position;

  ToAndFro() {
    velocity = time.unaryExpr([](double t) { return std::fmod(t + 1e-9, 8) < 4 ? 0.5 : -0.5; });
    position = VectorXd::Zero(time.size());
    for (Eigen::Index i = 1; i < time.size(); ++i) {
      position[i] = position[i - 1] + kSampleStep * velocity[i - 1];
    }
  }
  VectorXd Torque(const Set& set) const {
    Scenario scenario;
    set(scenario.disturbances);
    Simulation recording;
    recording.truth.velocity = velocity;
    Measurements& log = recording.measurements;
    log.time = time;
    log.torque = recording.truth.force = VectorXd::Zero(time.size());
    DisturbLog(scenario, 0, recording, position);
    return recording.measurements.torque;
  }
};

TEST(HiddenForces, BacklashLacksItsLevelOverItsWay) {
  const VectorXd torque = ToAndFro().Torque([](auto& set) { set.hidden.backlash = {3, 0.4}; });
  // 0.4 rad take 0.8 s; the sample of the turn has still gone nothing
  EXPECT_EQ(torque[400], 3);
  EXPECT_EQ(torque[479], 3);
  EXPECT_EQ(torque[481], 0);
  EXPECT_EQ(torque[801], -3);
}

TEST(HiddenForces, HysteresisDiesAwayWithTheWay) {
  const VectorXd torque = ToAndFro().Torque([](auto& set) { set.hidden.hysteresis = {3, 0.2}; });
  for (const int k : {0, 10, 100}) {
    EXPECT_NEAR(torque[400 + k], 3 * std::exp(-0.5 * kSampleStep * k / 0.2), 1e-9) << k;
  }
}

TEST(HiddenForces, MemoryFollowsTheSpeedLate) {
  ToAndFro motion;
  motion.velocity.tail(801).setConstant(1);  // from 0.5 to 1 in size
  const VectorXd torque = motion.Torque([](auto& set) { set.hidden.memory = {4, 0.5}; });
  EXPECT_EQ(torque[700], 0);
  for (const int k : {1, 50, 200}) {
    EXPECT_NEAR(torque[800 + k], -4 * 0.5 * std::exp(-kSampleStep * k / 0.5), 1e-9) << k;
  }
}

TEST(HiddenForces, DragRippleAndSpringAreFormulas) {
  const ToAndFro motion;
  const VectorXd torque = motion.Torque([](Disturbances& set) {
    set.hidden.quadratic_drag.coefficient = 2;
    set.hidden.ripple = {0.3, 0.7};
    set.hidden.spring.stiffness = 5;
  });
  for (const int i : {37, 700, 1200}) {
    const double v = motion.velocity[i], p = motion.position[i];
    const double ripple = 0.3 * std::sin(2 * std::numbers::pi * p / 0.7);
    EXPECT_NEAR(torque[i], 2 * v * std::abs(v) + std::copysign(1, v) * ripple + 5 * p, 1e-12);
  }
}

TEST(HiddenForces, InertiaActsWhileTheSpeedChanges) {
  ToAndFro motion;
  motion.velocity = 0.2 * motion.time;
  const VectorXd torque = motion.Torque([](auto& set) { set.hidden.inertia.inertia = 3; });
  EXPECT_NEAR(torque[500], 0.6, 1e-9);
}

/// Two hours at 1 Hz; position, velocity and torque are plain functions of time.
Simulation Example() {
  Simulation recording;
  Measurements& log = recording.measurements;
  log.time = Eigen::VectorXd::LinSpaced(7201, 0, 7200);
  log.position = 0.1 * log.time;
  log.velocity = Eigen::VectorXd::Constant(7201, 0.1);
  log.torque = 10 * (0.01 * log.time.array()).sin();
  log.load = log.time;
  recording.truth.velocity = log.velocity;
  recording.truth.force = recording.truth.loss = recording.truth.energy = log.torque;
  return recording;
}

/// The example with the faults that `set` sets.
Simulation Spoilt(const std::function<void(SensorFaults&)>& set) {
  Scenario scenario;
  set(scenario.disturbances.faults);
  Simulation recording = Example();
  DisturbLog(scenario, 0, recording, recording.measurements.position);
  return recording;
}

Measurements SpoiltLog(const std::function<void(SensorFaults&)>& set) {
  return Spoilt(set).measurements;
}

TEST(SensorFaults, ChangeTheTorqueByDriftLimitsAndSteps) {
  const Eigen::VectorXd plain = Example().measurements.torque;
  const auto torque = [](const std::function<void(SensorFaults&)>& set) {
    return SpoiltLog(set).torque;
  };
  EXPECT_NEAR(torque([](auto& set) {
                set.sensor_drift = {0.5, -0.1};
              })[5400],
              plain[5400] * 0.85 + 0.75, 1e-12);
  const Eigen::VectorXd gain = torque([](auto& set) { set.gain_step = {2, 100}; });
  EXPECT_EQ(gain[99], plain[99]);
  EXPECT_EQ(gain[100], 2 * plain[100]);
  const Eigen::VectorXd clipped = torque([](auto& set) { set.clipped.level = 4; });
  EXPECT_EQ(clipped.maxCoeff(), 4);
  EXPECT_EQ(clipped.minCoeff(), -4);
  const Eigen::VectorXd dead = torque([](auto& set) { set.dead_band.level = 4; });
  EXPECT_EQ(dead[10], 0);
  EXPECT_NEAR(dead[150], plain[150] - 4, 1e-12);
  const Eigen::VectorXd coarse = torque([](auto& set) { set.torque_resolution.resolution = 0.5; });
  EXPECT_EQ((2 * coarse.array() - (2 * coarse.array()).round()).abs().maxCoeff(), 0);
  EXPECT_LE((coarse - plain).cwiseAbs().maxCoeff(), 0.25);
  const Eigen::VectorXd late = torque([](auto& set) { set.late_torque.samples = 3; });
  EXPECT_EQ(late[10], plain[7]);
  EXPECT_EQ(late[2], plain[0]);
}

TEST(SensorFaults, LetColumnsStickAndScaleOrHoldWhatTheirNamesDoNotSay) {
  const Measurements plain = Example().measurements;
  const Eigen::VectorXd stuck = SpoiltLog([](auto& set) {
                                  set.stuck_position = {100, 60};
                                }).position;
  EXPECT_EQ(stuck[159], stuck[99]);
  EXPECT_EQ(stuck[160], 16);
  EXPECT_EQ(SpoiltLog([](auto& set) {
              set.stuck_torque = {100, 60};
            }).torque[150],
            plain.torque[99]);
  const Measurements scaled = SpoiltLog([](auto& set) { set.column_scale = {57, -1, 2}; });
  EXPECT_EQ(scaled.position[10], 57);
  EXPECT_EQ(scaled.velocity[10], -0.1);
  EXPECT_EQ(scaled.torque[10], 2 * plain.torque[10]);
  EXPECT_EQ(SpoiltLog([](auto& set) { set.unsigned_torque = true; }).torque,
            plain.torque.cwiseAbs());
  EXPECT_EQ(SpoiltLog([](auto& set) { set.reversed_torque = true; }).torque[10],
            plain.torque[7190]);
  const Measurements swapped = SpoiltLog([](auto& set) { set.swapped_columns = true; });
  EXPECT_EQ(swapped.torque, plain.velocity);
  EXPECT_EQ(swapped.velocity, plain.torque);
  EXPECT_FALSE(SpoiltLog([](auto& set) { set.without_load = true; }).load);
}

TEST(SensorFaults, LeaveSamplesOutOfLogAndTruth) {
  const Simulation cut = Spoilt([](auto& set) { set.cut_start.time = 20; });
  EXPECT_EQ(cut.measurements.size(), 7181);
  EXPECT_EQ(cut.measurements.time[0], 20);
  EXPECT_EQ((*cut.measurements.load)[0], 20);
  EXPECT_EQ(cut.truth.force.size(), 7181);
  EXPECT_EQ(cut.truth.energy[0], Example().truth.energy[20]);
  const Simulation gap = Spoilt([](auto& set) { set.gap = {100, 50}; });
  EXPECT_EQ(gap.measurements.size(), 7151);
  EXPECT_EQ(gap.measurements.time[99], 99);
  EXPECT_EQ(gap.measurements.time[100], 150);
  EXPECT_EQ(gap.truth.energy.size(), 7151);

  // a clock that begins anew, in a log without samples, too
  const auto restarted = [](double begin) {
    return SpoiltLog([&](auto& set) {
      set.cut_start.time = begin;
      set.restarted_clock = true;
    });
  };
  EXPECT_EQ(restarted(20).time[0], 0);
  EXPECT_EQ(restarted(10'000).size(), 0);
}

TEST(SensorFaults, LetClocksRunWrongAndUneven) {
  const Eigen::VectorXd time = SpoiltLog([](auto& set) { set.clock = {1.1, 0.4}; }).time;
  const Eigen::ArrayXd off = (time - 1.1 * Example().measurements.time).array();
  EXPECT_LE(off.abs().maxCoeff(), 0.2 + 1e-9);
  // even over half a step to either side: variance 0.4^2 / 12
  EXPECT_NEAR(off.square().mean(), 0.16 / 12, 1e-4);
  EXPECT_NEAR(off.mean(), 0, 1e-3);
  EXPECT_TRUE((time.tail(7200).array() > time.head(7200).array()).all());
}

}  // namespace
}  // namespace warmjoint
