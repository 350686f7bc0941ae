// What code does to the columns of a recording.
#pragma once

#include <warmjoint/recording.h>

#include <Eigen/Core>
#include <cmath>
#include <vector>

namespace warmjoint {

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
  return measurements.motor_position ||
         (std::abs(measurements.gear) != 1 && !measurements.position_integrated);
}

/// What cannot be told by a log without positions, one sentence.
inline constexpr const char* kNoPositions =
    "the log has no positions: they are integrated from the velocity, and gravity and what repeats "
    "over the position "
    "cannot be told";

/// The logged motor position, else gear times the joint's. [N] rad
inline Eigen::VectorXd MotorPosition(const Measurements& measurements) {
  return measurements.motor_position.value_or(measurements.gear * measurements.position);
}

/// Samples first, ..., first + count - 1 of a log.
struct SampleRange {
  Eigen::Index first = 0, count = 0;
};

/// The same selection without samples of velocity 0. Friction at v = 0 is whatever holds the joint,
/// not what the law gives, so that such a sample tells a fit nothing; it still warms or cools the
/// joint.
inline Selection WithoutRest(const Selection& selection, const Measurements& measurements) {
  return {selection.keep && measurements.velocity.array() != 0, selection.segments};
}

}  // namespace warmjoint
