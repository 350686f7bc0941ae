// The friction of Sec. III over sampled velocities, without an engine.
#pragma once

#include <Eigen/Core>

#include "models/friction/friction_description.h"

namespace warmjoint::inline sim {

/// Friction, loss and energy of N samples.
struct FrictionHistory {
  Eigen::VectorXd force;   // [N] F, N.m or N
  Eigen::VectorXd loss;    // [N] W, W
  Eigen::VectorXd energy;  // [N] E, N.m or N
};

/// What a joint does and meets at N samples. Empty: 0 throughout.
struct JointCourse {
  Eigen::VectorXd velocity;        // [N] rad/s or m/s
  Eigen::VectorXd position{};      // [N] rad or m
  Eigen::VectorXd load{};          // [N] that the joint transmits, N.m or N
  Eigen::VectorXd ambient_rise{};  // [N] Ts - T0, K
  Eigen::VectorXd level{};         // [N] A, what else joins E, N.m or N
};

/// Closes the loop between friction and heat, from sample to sample, always sliding steadily:
///   F = Fn(v) + sign(v) (E + A) + maps and load (LevelTerms)     (20)
///   W = |F v|                                                    (19)
///   E[i+1] by Heat                                               (22)
/// friction: checked; initial_energy: E1[0], N.m or N, E2[0] is 0; step: h, s.
/// The history's energy is E1 + E2. Throws BadInput from `place` where friction changes its sign
/// and feeds itself (E below -Fn sign(v)): from there on the model has left its domain.
FrictionHistory SimulateFriction(const FrictionDescription& friction, double initial_energy,
                                 double step, const JointCourse& course, const Place& place);

}  // namespace warmjoint::inline sim
