// One instance of the plugin: the friction of its joints, in whichever model it is called with, and what it reports: warnings
// that it gives once, sensors.
#pragma once

#include <mujoco/mujoco.h>

#include <vector>

#include "sim/plugin/bound_joints.h"
#include "sim/plugin/joint_rows.h"
#include "sim/plugin/joint_states.h"

namespace warmjoint {

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

/// Friction of the joints of one plugin instance, in two forms:
///   actuator: actuators refer to the instance; states in mjData.act, forces in actuator_force
///   passive:  none refers to it; states in plugin_state, forces in qfrc_passive
/// Keeps no state of its own beyond scratch, which is filled and used up within one step, and what a
/// step has left, which tells where nothing has to look for another model.
class FrictionInstance {
 public:
  /// Throws BadInput as BoundJoints does.
  FrictionInstance(const mjModel* m, int instance);

  bool passive() const { return bound_.passive(); }

  /// Actuator form: steps every joint and writes act_dot = (next - now) / h, so that the engine's
  /// Euler step of act lands on the next state; keeps the forces for ApplyActuators. Under RK4,
  /// which asks at four stages, act_dot is 0 and Advance writes the states. Allocates and locks
  /// nothing unless the model is another one than before, for which nothing looks while a run goes on.
  void StepActuators(const mjModel* m, mjData* d);

  /// Actuator form: writes actuator_force = -F of the last step.
  void ApplyActuators(const mjModel* m, mjData* d) const;

  /// Passive form: steps every joint and takes F from qfrc_passive.
  void StepPassive(const mjModel* m, mjData* d);

  /// Writes the instance's part of plugin_state at a reset.
  void Reset(const mjModel* m, mjtNum* state);

  /// Lets the step that follows write sensordata; writes zeros where none will follow.
  void Sense(const mjModel* m, mjData* d);

  /// Commits the states of the last step: plugin_state, or act where the engine's own integration
  /// of it would not do (RK4, or a state that was not finite).
  void Advance(const mjModel* m, mjData* d);

 private:
  /// Where the engine keeps a joint of the actuator form.
  struct Driven {
    int group;   // of its actuator
    int state;   // in act
    int states;  // so many from there
    int output;  // in actuator_force
  };

  void Bind(const mjModel* m);
  void TakeNumbers(const mjModel* m);
  bool GoesOn(const mjModel* m, const mjData* d) const;
  void Rebind(const mjModel* m);
  void ReadNumbers(const mjModel* m);
  void Prepare(const mjModel* m, mjData* d);
  void Step(const mjModel* m, mjData* d, const mjtNum* load);
  void BeginJoints(const mjData* d, bool warm);
  void AdvancePassive(const mjModel* m, mjData* d);
  void AdvanceActuators(const mjModel* m, mjData* d);
  void CorrectActs(const mjModel* m, mjData* d) const;

  int instance_;
  BoundJoints bound_;
  JointRows rows_;
  LeftStates left_;
  FrictionSensors sensors_;
  std::vector<Driven> driven_;  // of each joint; empty in the passive form
  double timestep_ = 0;
  int integrator_ = 0;
  int flags_ = 0;               // mjOption.disableflags
  int mark_ = -1;               // where the mark is among the instance's entries of plugin_state
  bool checked_ = true;         // the numbers, against the inertia
  bool euler_ = false;          // the engine's step of act lands where the last step shall end
  bool stepped_ = false;        // since the last Advance
  bool needs_ambient_ = false;  // by one of the joints
  std::vector<mjtNum> load_;    // [nv] where a joint of the passive form needs it
};

}  // namespace warmjoint
