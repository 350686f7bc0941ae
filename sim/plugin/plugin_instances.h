// The instances of the plugin in a model: which joints each of them acts on.
#pragma once

#include <mujoco/mujoco.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "sim/plugin/prepared_joints.h"

namespace warmjoint::inline sim {

/// The name of an object of the model; empty where it has none.
std::string NameIn(const mjModel* m, mjtObj type, int id);

/// The names in the attribute `joints`; "": every joint.
std::vector<std::string> JointsOf(const PreparedInstance& prepared);

/// Whether an actuator refers to the instance; one that none refers to is passive.
bool DrivenByActuators(const mjModel* m, int instance);

/// The joints of a passive instance: each joint of the model that `joints` names, in the model's
/// order.
struct PassiveJoint {
  int joint;
  const PreparedJoint* prepared;
};

/// Throws BadInput where `joints` names one that the model lacks.
std::vector<PassiveJoint> FindPassive(const mjModel* m, int instance,
                                      const PreparedInstance& prepared);

/// Numbers of state that the joints of a passive instance need together. Throws BadInput.
int PassiveStates(const mjModel* m, int instance);

/// What has given a joint friction already, of the plugin in this slot: an actuator, or one of the passive instances
/// before `end`; empty where nothing has. Throws BadInput for attributes that cannot be read.
std::string FrictionOn(const mjModel* m, int joint, int plugin, int end);

/// Throws BadInput where another friction acts on the joint: two would be one that is stiffer than
/// the step can carry.
void RefuseSecond(const mjModel* m, int instance, int joint);

/// Instances by the kinematic trees on which they act.
using OtherInstances = std::map<int, std::set<int>>;

/// The instances beside this one.
OtherInstances FindOthers(const mjModel* m, int instance);

}  // namespace warmjoint::inline sim
