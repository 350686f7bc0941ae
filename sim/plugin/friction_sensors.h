// What the model's sensors tell of an instance's joints.
#pragma once

#include <mujoco/mujoco.h>

#include <vector>

#include "sim/plugin/bound_joints.h"
#include "sim/plugin/joint_rows.h"

namespace warmjoint::inline sim {

/// Writes sensordata of an instance's sensors, kSensed numbers for each joint. The engine asks before
/// the step has found them, so that the step writes them.
class FrictionSensors {
 public:
  /// The engine asks: zeros where friction is off, else the step that follows writes.
  void Ask(const mjModel* m, mjData* d, const BoundJoints& bound, bool off);

  /// The step tells, and writes where it was asked to.
  void Tell(const mjModel* m, mjData* d, const BoundJoints& bound, const JointRows& rows) {
    if (!bound.sensors().empty()) Note(m, d, bound, rows);
  }

 private:
  void Note(const mjModel* m, mjData* d, const BoundJoints& bound, const JointRows& rows);
  void Write(const mjModel* m, mjData* d, const BoundJoints& bound) const;

  bool asked_ = false;
  std::vector<double> sensed_;  // [joints x kSensed] of the last step
};

}  // namespace warmjoint::inline sim
