// What an instance reports: its entries in mjData.plugin_state, warnings that it gives once, sensors.
#pragma once

#include <mujoco/mujoco.h>

#include <vector>

#include "sim/plugin/bound_joints.h"
#include "sim/plugin/joint_rows.h"
#include "sim/plugin/register.h"

namespace warmjoint {

/// Entries of mjData.plugin_state of each instance, before the states of a passive one's joints. One
/// more stands behind those: the mark of the attributes with which the state was stepped or reset
/// (AttributeWatch), which tells apart states of models that one place in memory holds in turn. Never
/// read by the dynamics.
enum FrictionReport : int {
  /// The sum of 2^i over those of the instance's joints, counted from 0 in their order (BoundJoints),
  /// in which friction would have pushed, until a reset. Never read by the dynamics.
  kReportsPush,
  /// 1 where the model's step was set to one that cannot carry the friction, until a reset. Never
  /// read by the dynamics.
  kReportsStep,
  /// Passive form: rise of the ambient temperature, Ts - T0, K, for all joints; 0 after a reset.
  kAmbientRise,
  /// Actuator form: 1 from a reset to the first step where joints start warm; that step begins at
  /// their initial energy where act holds 0.
  kStartsWarm = kAmbientRise,
  kFrictionReports,
};

/// So many are in plugin_state beside the states of a passive instance's joints.
inline constexpr int kFrictionEntries = kFrictionReports + 1;

/// Warns, once until a reset, of a joint whose step or numbers a program set after loading to what
/// the step does not bear, or that drives may shake (CheckDrive); they are taken as they are.
void WarnOfNumbers(const mjModel* m, mjData* d, int instance,
                   const std::vector<BoundJoint>& joints);

/// Warns, once until a reset for each joint, that friction would push it. place: of the joint.
void WarnOfPush(const mjModel* m, mjData* d, int instance, const std::vector<BoundJoint>& joints,
                size_t place);

/// Writes sensordata of an instance's sensors, kSensed numbers for each joint. The engine asks before
/// the step has found them, so that the step writes them.
class FrictionSensors {
 public:
  /// The engine asks: zeros where friction is off, else the step that follows writes.
  void Ask(const mjModel* m, mjData* d, const BoundJoints& bound, bool off);

  /// After the step: writes where the engine has asked.
  void Note(const mjModel* m, mjData* d, const BoundJoints& bound, const JointRows& rows) {
    if (asked_) WriteStep(m, d, bound, rows);
  }

 private:
  void WriteStep(const mjModel* m, mjData* d, const BoundJoints& bound, const JointRows& rows);
  void Write(const mjModel* m, mjData* d, const BoundJoints& bound) const;

  bool asked_ = false;
  std::vector<double> sensed_;  // [joints x kSensed] of the last step
};

}  // namespace warmjoint
