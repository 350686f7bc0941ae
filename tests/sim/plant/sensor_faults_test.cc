#include "sim/plant/disturb_log.h"

#include <gtest/gtest.h>

#include <cmath>

namespace warmjoint {
namespace {

/// Two hours at 1 Hz; position, velocity and torque are plain functions of time.
Recording Example() {
  Recording recording;
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

Recording Spoilt(const SensorFaults& faults) {
  Recording recording = Example();
  SpoilLog(faults, recording);
  return recording;
}

TEST(SensorFaults, NoneByDefault) {
  EXPECT_EQ(Spoilt({}).measurements.torque, Example().measurements.torque);
  EXPECT_EQ(Spoilt({}).measurements.time, Example().measurements.time);
}

TEST(SensorFaults, DriftAndStepChangeTheTorque) {
  const Eigen::VectorXd plain = Example().measurements.torque;
  SensorFaults faults;
  faults.sensor_drift = {0.5, -0.1};
  EXPECT_NEAR(Spoilt(faults).measurements.torque[5400], plain[5400] * 0.85 + 0.75, 1e-12);
  faults = {};
  faults.gain_step = {2, 100};
  EXPECT_EQ(Spoilt(faults).measurements.torque[99], plain[99]);
  EXPECT_EQ(Spoilt(faults).measurements.torque[100], 2 * plain[100]);
}

TEST(SensorFaults, LimitsOfTheTorque) {
  SensorFaults faults;
  faults.clipped.level = 4;
  EXPECT_EQ(Spoilt(faults).measurements.torque.maxCoeff(), 4);
  EXPECT_EQ(Spoilt(faults).measurements.torque.minCoeff(), -4);
  faults = {};
  faults.dead_band.level = 4;
  const Eigen::VectorXd plain = Example().measurements.torque;
  const Eigen::VectorXd torque = Spoilt(faults).measurements.torque;
  EXPECT_EQ(torque[10], 0);
  EXPECT_NEAR(torque[150], plain[150] - 4, 1e-12);
}

TEST(SensorFaults, TheTorqueComesInSteps) {
  SensorFaults faults;
  faults.torque_resolution.resolution = 0.5;
  const Eigen::ArrayXd plain = Example().measurements.torque;
  const Eigen::ArrayXd torque = Spoilt(faults).measurements.torque;
  EXPECT_EQ((2 * torque - (2 * torque).round()).abs().maxCoeff(), 0);
  EXPECT_LE((torque - plain).abs().maxCoeff(), 0.25);
}

TEST(SensorFaults, ColumnsStickForAWhile) {
  SensorFaults faults;
  faults.stuck_position = {100, 60};
  const Eigen::VectorXd position = Spoilt(faults).measurements.position;
  EXPECT_EQ(position[159], position[99]);
  EXPECT_EQ(position[160], 16);
  faults = {};
  faults.stuck_torque = {100, 60};
  EXPECT_EQ(Spoilt(faults).measurements.torque[150], Example().measurements.torque[99]);
}

TEST(SensorFaults, ScalesAndLateTorque) {
  SensorFaults faults;
  faults.column_scale = {57, -1, 2};
  const Measurements scaled = Spoilt(faults).measurements;
  EXPECT_EQ(scaled.position[10], 57);
  EXPECT_EQ(scaled.velocity[10], -0.1);
  faults = {};
  faults.late_torque.samples = 3;
  const Eigen::VectorXd plain = Example().measurements.torque;
  EXPECT_EQ(Spoilt(faults).measurements.torque[10], plain[7]);
  EXPECT_EQ(Spoilt(faults).measurements.torque[2], plain[0]);
}

TEST(SensorFaults, WhatIsCutIsGoneFromLogAndTruth) {
  SensorFaults faults;
  faults.cut_start.time = 20;
  Recording recording = Spoilt(faults);
  EXPECT_EQ(recording.measurements.size(), 7181);
  EXPECT_EQ(recording.measurements.time[0], 20);
  EXPECT_EQ((*recording.measurements.load)[0], 20);
  EXPECT_EQ(recording.truth.force.size(), 7181);
  EXPECT_EQ(recording.truth.energy[0], Example().truth.energy[20]);
  faults.restarted_clock = true;
  EXPECT_EQ(Spoilt(faults).measurements.time[0], 0);
}

TEST(SensorFaults, GapsLeaveNoSamples) {
  SensorFaults faults;
  faults.gap = {100, 50};
  const Recording recording = Spoilt(faults);
  EXPECT_EQ(recording.measurements.size(), 7151);
  EXPECT_EQ(recording.measurements.time[99], 99);
  EXPECT_EQ(recording.measurements.time[100], 150);
  EXPECT_EQ(recording.truth.energy.size(), 7151);
}

TEST(SensorFaults, ColumnsHoldWhatTheirNamesDoNotSay) {
  const Measurements plain = Example().measurements;
  SensorFaults faults;
  faults.unsigned_torque = true;
  EXPECT_EQ(Spoilt(faults).measurements.torque, plain.torque.cwiseAbs());
  faults = {};
  faults.reversed_torque = true;
  EXPECT_EQ(Spoilt(faults).measurements.torque[10], plain.torque[7190]);
  faults = {};
  faults.swapped_columns = true;
  EXPECT_EQ(Spoilt(faults).measurements.torque, plain.velocity);
  EXPECT_EQ(Spoilt(faults).measurements.velocity, plain.torque);
  faults = {};
  faults.without_load = true;
  EXPECT_FALSE(Spoilt(faults).measurements.load);
}

TEST(SensorFaults, ClocksRunWrongAndUneven) {
  SensorFaults faults;
  faults.clock = {1.1, 0.4};
  const Eigen::VectorXd time = Spoilt(faults).measurements.time;
  const Eigen::ArrayXd off = (time - 1.1 * Example().measurements.time).array();
  EXPECT_LE(off.abs().maxCoeff(), 0.2 + 1e-9);
  // even over half a step to either side: variance 0.4^2 / 12
  EXPECT_NEAR(off.square().mean(), 0.16 / 12, 1e-4);
  EXPECT_NEAR(off.mean(), 0, 1e-3);
  EXPECT_TRUE((time.tail(7200).array() > time.head(7200).array()).all());
}

TEST(SensorFaults, AClockRestartsInALogWithoutSamplesToo) {
  SensorFaults faults;
  faults.cut_start = {10'000};
  faults.restarted_clock = true;
  EXPECT_EQ(Spoilt(faults).measurements.size(), 0);
}

}  // namespace
}  // namespace warmjoint
