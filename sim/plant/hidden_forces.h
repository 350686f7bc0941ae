// Torques of a joint that no model of an identifier holds.
#pragma once

#include <Eigen/Core>

#include "scenarios/disturbances.h"

namespace warmjoint::inline sim {

/// What hold_parity, step_in_time, run_in and HiddenForces add to the torque along a motion. They do not warm the joint.
/// time: [N] s; velocity: [N] true, rad/s or m/s; position: [N] true, rad or m; acceleration: [N] true, rad/s^2 or m/s^2,
/// or empty: as neighbouring samples show it; returns [N] N.m or N.
Eigen::VectorXd HiddenTorque(const Disturbances& disturbances, const Eigen::VectorXd& time,
                             const Eigen::VectorXd& velocity, const Eigen::VectorXd& position,
                             const Eigen::VectorXd& acceleration = {});

}  // namespace warmjoint::inline sim
