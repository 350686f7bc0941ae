// The angle of a joint's motor, as far as a recording knows it.
#pragma once

#include <cmath>

#include "models/recording/measurements.h"

namespace warmjoint::inline models {

/// Whether the motor's angle is told apart from the joint's: logged, or turned by a gear. A gear of
/// -1 turns the motor against the joint by the same angle, which tells nothing new.
inline bool KnowsMotorAngle(const Measurements& measurements) {
  return measurements.motor_position || std::abs(measurements.gear) != 1;
}

/// The logged motor position, else gear times the joint's. [N] rad
inline Eigen::VectorXd MotorPosition(const Measurements& measurements) {
  return measurements.motor_position.value_or(measurements.gear * measurements.position);
}

}  // namespace warmjoint::inline models
