// The friction of Sec. III over sampled velocities, without an engine.
#pragma once

#include <Eigen/Core>

#include "models/friction/friction_description.h"

namespace warmjoint {

/// Friction, loss and energy of N samples.
struct FrictionHistory {
  Eigen::VectorXd force;   // [N] F, N.m or N
  Eigen::VectorXd loss;    // [N] W, W
  Eigen::VectorXd energy;  // [N] E, N.m or N
};

/// Closes the loop between friction and heat, from sample to sample:
///   F = Fn(v) + sign(v) E                (20)
///   W = |F v|                            (19)
///   E[i+1] = te E[i] + ke W[i]           (22)
/// friction: checked; initial_energy: E[0], N.m or N; step: h, s; velocity: [N] rad/s or m/s.
/// Throws BadInput from `place` where friction changes its sign and feeds itself (E < -Fn sign(v)):
/// from there on the model has left its domain.
FrictionHistory SimulateFriction(const FrictionDescription& friction, double initial_energy,
                                 double step, const Eigen::VectorXd& velocity, const Place& place);

}  // namespace warmjoint
