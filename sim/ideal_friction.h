// The friction of Sec. III over sampled velocities, without an engine.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "models/friction/friction_description.h"

namespace warmjoint {

/// Friction, loss and energy of N samples.
struct FrictionHistory {
  Eigen::VectorXd force;   // [N] F, N.m or N
  Eigen::VectorXd loss;    // [N] W, W
  Eigen::VectorXd energy;  // [N] E, N.m or N
};

/// What else shapes the level of friction. Absent and empty: nothing.
struct LevelInfluences {
  std::optional<Thermal> second_heat;  // a second energy state E2, fed by the same W
  Eigen::VectorXd level;               // [N] A, N.m or N: ambient temperature, load
};

/// Closes the loop between friction and heat, from sample to sample:
///   F = Fn(v) + sign(v) (E + E2 + A)     (20)
///   W = |F v|                            (19)
///   E[i+1] = te E[i] + ke W[i]           (22), E2 likewise from 0
/// friction: checked; initial_energy: E[0], N.m or N; step: h, s; velocity: [N] rad/s or m/s.
/// The history's energy is E + E2. Throws BadInput from `place` where friction changes its sign and
/// feeds itself (E below -Fn sign(v)): from there on the model has left its domain.
FrictionHistory SimulateFriction(const FrictionDescription& friction, double initial_energy,
                                 double step, const Eigen::VectorXd& velocity, const Place& place,
                                 const LevelInfluences& influences = {});

}  // namespace warmjoint
