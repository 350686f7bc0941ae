// What a robot can log. Identifiers see this and nothing else.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "models/friction/joint_kind.h"
#include "models/recording/sampling.h"

namespace warmjoint::inline models {

/// Most samples of a recording, read or simulated: 14 h at 1 kHz, and some 15 GB while it is identified.
inline constexpr Eigen::Index kMostSamples = 50'000'000;

/// The log of one joint: N samples in order of time. SI (rad or m, s) whatever the file had.
struct Measurements {
  JointKind joint = JointKind::rotary;
  std::string torque_unit = "N.m";  // "N" for linear joints; "A" where a current was logged
  double gear = 1;                  // motor position = gear * joint position
  std::string source;               // file that it came from, for messages
  std::vector<std::string> notes;   // what reading made of it: one phrase each, for people

  Eigen::VectorXd time;                           // [N] s, strictly increasing
  Eigen::VectorXd position;                       // [N] rad or m
  Eigen::VectorXd velocity;                       // [N] rad/s or m/s
  Eigen::VectorXd torque;                         // [N] torque_unit
  std::optional<Eigen::VectorXd> motor_position;  // [N] rad
  std::optional<Eigen::VectorXd> load;            // [N] N.m or N
  std::optional<Eigen::VectorXd> temperature;     // [N] degC
  /// [N] rad/s^2 or m/s^2: no log holds it; preparation finds it for fits to motion of any kind.
  std::optional<Eigen::VectorXd> acceleration;
  /// [N] rad/s or m/s, the same: mean of |v| until the next sample, and mean of v^2 over that, with
  /// the sign of v, at which a straight line of force over speed has its mean loss.
  std::optional<Eigen::VectorXd> mean_speed;
  std::optional<Eigen::VectorXd> loss_velocity;

  /// Of several recordings joined (join_recordings.h): the first sample of each but the first. The
  /// joint is cold there again.
  std::vector<Eigen::Index> starts;

  /// Of rows that are means of several samples, whose times no longer tell: the gaps between the
  /// samples, where a row begins behind each. Otherwise nothing, and gaps are found by the time.
  std::optional<std::vector<LogGap>> gaps;

  Eigen::Index size() const { return time.size(); }
};

/// Calls use(column) for every column that the log has: the one list of them, for what is done to
/// all alike.
template <typename Log, typename Use>
void ForEachColumn(Log& log, Use&& use) {
  for (auto* column : {&log.time, &log.position, &log.velocity, &log.torque}) use(*column);
  for (auto* column : {&log.motor_position, &log.load, &log.temperature, &log.acceleration,
                       &log.mean_speed, &log.loss_velocity}) {
    if (*column) use(**column);
  }
}

/// The first n samples.
Measurements FirstSamples(Measurements log, Eigen::Index n);

/// Whether the motor's angle is told apart from the joint's: logged, or turned by a gear. A gear of
/// -1 turns the motor against the joint by the same angle, which tells nothing new.
inline bool KnowsMotorAngle(const Measurements& measurements) {
  return measurements.motor_position || std::abs(measurements.gear) != 1;
}

/// The logged motor position, else gear times the joint's. [N] rad
inline Eigen::VectorXd MotorPosition(const Measurements& measurements) {
  return measurements.motor_position.value_or(measurements.gear * measurements.position);
}

/// Samples first, ..., first + count - 1 of a log.
struct SampleRange {
  Eigen::Index first = 0, count = 0;
};

/// The samples of each recording, in order: all of them where the log is one.
inline std::vector<SampleRange> RecordingsOf(const Measurements& log) {
  std::vector<SampleRange> recordings;
  Eigen::Index first = 0;
  for (const Eigen::Index start : log.starts) {
    recordings.push_back({first, start - first});
    first = start;
  }
  recordings.push_back({first, log.size() - first});
  return recordings;
}

}  // namespace warmjoint::inline models
