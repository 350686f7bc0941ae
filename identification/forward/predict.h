// The torque that a friction predicts over a recorded motion.
#pragma once

#include <Eigen/Core>

#include "models/friction/friction_description.h"
#include "models/recording/measurements.h"

namespace warmjoint::inline identification {

/// Friction along a motion: F = Fn(v) + sign(v) E + maps, Eq. (20), with E from the friction's own
/// losses W = |F v|, Eqs. (19) and (22). All N samples, rests and accelerations too. F is that of
/// steady sliding, but LuGre's bristle follows the motion (bristle_course.h).
struct Prediction {
  Eigen::VectorXd force;   // [N] F, N.m or N; 0 at rest, but for a bristle's load
  Eigen::VectorXd energy;  // [N] E, N.m or N; 0 where nothing warms
  /// First sample at which warm friction pushes instead of braking and so feeds itself; N if none.
  Eigen::Index feeds_itself = 0;
};

/// How LuGre's bristle is bent at the start of each recording: as in steady sliding, or as the
/// measured torque tells.
enum class BristleStart { sliding, torque };

/// Uses time and velocity and, for maps, positions and load. friction must have been checked
/// (CheckFriction). initial_energy: E at the first sample, N.m or N; further recordings that were
/// joined to it start cold.
Prediction PredictFriction(const FrictionDescription& friction, const Measurements& measurements,
                           double initial_energy = 0, BristleStart start = BristleStart::sliding);

}  // namespace warmjoint::inline identification
