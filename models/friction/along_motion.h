// The forward model: what a joint's friction does along a motion that is recorded or prescribed.
#pragma once

#include <warmjoint/friction_model.h>

#include "models/friction/joint_friction.h"

namespace warmjoint {

/// One joint's friction as a model of its torque. Laws without a bristle of their own slide
/// steadily wherever the joint moves, by JointFriction::SlidingForce,
///   F = Fn(v) + b E v + sign(v) (E + A + c |load|) + maps                           (20)
///   W = |F v|, or the mean speed times F at the loss velocity where both are given  (19)
/// and carry at rest what the motion does not tell, for which F is 0. The bristle of others follows
/// the motion (BristleState), and they lose what it does not store.
/// E1 and E2 take the exact step of Heat, Eq. (22), over each interval.
class AlongMotion {
 public:
  /// friction: checked (CheckFriction), or one with all values of its law, within bounds or not.
  explicit AlongMotion(const Friction& friction);

  Prediction Predict(const JointTrajectory& trajectory, const ThermalStart& start = {}) const;

 private:
  Friction friction_;
  JointFriction joint_;
};

}  // namespace warmjoint
