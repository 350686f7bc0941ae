// One instance of the plugin: the friction of its joints, in whichever model it is called with.
#pragma once

#include <mujoco/mujoco.h>

#include <vector>

#include "models/friction/joint_friction.h"
#include "sim/plugin/bound_joints.h"
#include "sim/plugin/coupled_bristles.h"

namespace warmjoint::inline sim {

/// Name under which MuJoCo knows the plugin.
inline constexpr char kFrictionPlugin[] = "warmjoint.friction";

/// Entries of mjData.plugin_state of each instance, before the states of a passive one's joints.
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

/// Friction of the joints of one plugin instance, in two forms:
///   actuator: actuators refer to the instance; states in mjData.act, forces in actuator_force
///   passive:  none refers to it; states in plugin_state, forces in qfrc_passive
/// Keeps no state of its own beyond scratch, which is filled and used up within one step.
class FrictionInstance {
 public:
  /// Reads the instance's attributes and checks them and its joints against the model.
  /// Throws BadInput that names actuator or joint, attribute, value and bound.
  FrictionInstance(const mjModel* m, int instance);

  bool passive() const { return bound_.passive(); }

  /// Actuator form: steps every joint and writes act_dot = (next - now) / h, so that the engine's
  /// Euler step of act lands on the next state; keeps the forces for ApplyActuators. Under RK4,
  /// which asks at four stages, act_dot is 0 and Advance writes the states. Allocates and locks
  /// nothing unless the model is another one than before.
  void StepActuators(const mjModel* m, mjData* d);

  /// Actuator form: writes actuator_force = -F of the last step.
  void ApplyActuators(const mjModel* m, mjData* d) const;

  /// Passive form: steps every joint and takes F from qfrc_passive.
  void StepPassive(const mjModel* m, mjData* d);

  /// Writes the instance's part of plugin_state at a reset.
  void Reset(const mjModel* m, mjtNum* state);

  /// Lets the step that follows write sensordata of the instance's sensors, kSensed numbers for each
  /// joint; writes zeros where none will follow.
  void Sense(const mjModel* m, mjData* d);

  /// Commits the states of the last step: plugin_state, or act where the engine's own integration
  /// of it would not do (RK4, or a state that was not finite).
  void Advance(const mjModel* m, mjData* d);

 private:
  void Bind(const mjModel* m);
  void Rebind(const mjModel* m);
  void BindBristles(const mjModel* m);
  void SetTimestep(const mjModel* m);
  void ShapeBristles();
  void WarnOfTimestep(const mjModel* m, mjData* d);
  void Prepare(const mjModel* m, mjData* d);
  void StepJoints(const mjModel* m, mjData* d);
  void ReadMotion(const mjModel* m, const mjData* d);
  void Report(const mjModel* m, mjData* d, const BoundJoint& joint);
  void NoteSensed(size_t i, const FrictionStep& step);
  void WriteSensors(const mjModel* m, mjData* d) const;

  int instance_;
  BoundJoints bound_;
  double timestep_ = 0;
  bool checked_ = true;   // the timestep, against the inertia
  bool stepped_ = false;  // since the last Advance
  bool senses_ = false;   // in the step that follows
  CoupledBristles bristles_;
  bool needs_load_ = false;  // by one of the joints

  // of the last step, [joints] each
  std::vector<FrictionState> now_;
  std::vector<JointMotion> motion_;
  std::vector<double> load_state_;    // that the bristles begin with, N.m or N
  std::vector<BristleStep> bristle_;  // where the step chooses it
  std::vector<double> force_;         // F, N.m or N
  std::vector<double> sensed_;        // [joints x kSensed]
  std::vector<double> next_;          // [states], in the order of the joints
  std::vector<double> load_;  // [nv] transmitted by each joint, where the passive form needs it
};

}  // namespace warmjoint::inline sim
