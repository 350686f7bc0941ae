// The joints of a plugin instance, found in a model.
#pragma once

#include <mujoco/mujoco.h>

#include <string>
#include <string_view>
#include <vector>

#include "models/friction/joint_friction.h"

namespace warmjoint::inline sim {

/// One joint and where its numbers stand in the model's data.
struct BoundJoint {
  int joint = 0;
  int dof = 0;
  int position = 0;   // in qpos
  int actuator = -1;  // -1 in the passive form
  int state = 0;      // in act, or in plugin_state in the passive form
  int control = -1;   // in ctrl; -1 where it has none
  int output = -1;    // in actuator_force; -1 in the passive form
  bool needs_load = false;
  bool needs_ambient = false;
  JointFriction friction;  // without a timestep
};

/// The joints of an instance in one model: in the order of its actuators, or of the model's joints
/// where no actuator refers to it (the passive form).
class BoundJoints {
 public:
  /// Reads the instance's attributes and checks them and its joints against the model. states:
  /// entries of plugin_state before those of the joints, in the passive form. Throws BadInput that
  /// names actuator or joint, attribute, value and bound.
  BoundJoints(const mjModel* m, int instance, int states);

  /// Whether these joints are those of the instance in that model. A model that was freed may have
  /// left its place in memory to another one.
  bool FitsModel(const mjModel* m) const {
    return m == model_ && m->plugin_attr + m->plugin_attradr[instance_] == text_ && SameText(m);
  }

  bool passive() const { return passive_; }
  std::vector<BoundJoint>& joints() { return joints_; }
  const std::vector<BoundJoint>& joints() const { return joints_; }

 private:
  bool SameText(const mjModel* m) const;
  void BindActuators(const mjModel* m);
  void BindPassive(const mjModel* m, int states);

  int instance_;
  const mjModel* model_;
  const char* text_;    // where the model holds its attributes
  std::string copy_;    // of them
  uint64_t signature_;  // of the model
  bool passive_;
  std::vector<BoundJoint> joints_;
};

/// Whether an actuator refers to the instance; one that none refers to is passive.
bool DrivenByActuators(const mjModel* m, int instance);

/// Numbers of state that the joints of a passive instance need together. Throws BadInput.
int PassiveStates(const mjModel* m, int instance);

}  // namespace warmjoint::inline sim
