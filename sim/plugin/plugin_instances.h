// The instances of the plugin in a model: which joints each of them acts on, and by which names.
#pragma once

#include <mujoco/mujoco.h>

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "models/friction/joint_friction.h"
#include "sim/plugin/prepared_instances.h"

namespace warmjoint {

/// The name of an object of the model; empty where it has none.
std::string NameIn(const mjModel* m, mjtObj type, int id);

// For messages: by name, as "joint 'name'", or by number, as "joint 3".

std::string JointName(const mjModel* m, int joint);
std::string ActuatorName(const mjModel* m, int actuator);
/// The name of the first actuator of a plugin instance, else its own.
std::string InstanceName(const mjModel* m, int instance);

/// Whether an actuator refers to the instance; one that none refers to is passive.
bool DrivenByActuators(const mjModel* m, int instance);

/// A joint on which an instance acts.
struct ActingJoint {
  int joint;     // -1 where the actuator drives none
  int actuator;  // -1 in the passive form
  std::shared_ptr<const PreparedJoint> prepared;
};

/// The joints of an instance: of each of its actuators, in their order, or in the passive form those that
/// `joints` names, in the order of the model. Names in `joints` may lack what MuJoCo put around every name
/// of a model that was attached to another one: what stands around the attribute `instance` in the
/// instance's name, else a beginning of that name, else what stands before the name of a driven joint; the
/// first of them by which every joint is found. Throws BadInput as PrepareInstance does, and where a joint is not found.
std::vector<ActingJoint> FindJoints(const mjModel* m, int instance);

/// What has given a joint friction already, of the plugin in this slot: one of the first `actuators`, or of the passive
/// ones among the first `instances`; empty where nothing has. Throws BadInput for attributes that cannot be read.
std::string FrictionOn(const mjModel* m, int joint, int plugin, int actuators, int instances);

/// Instances by the kinematic trees on which they act.
using OtherInstances = std::map<int, std::set<int>>;

/// The instances beside this one.
OtherInstances FindOthers(const mjModel* m, int instance);

/// Throws BadInput, naming actuator, property, value and remedy, unless the actuator drives a
/// joint directly and alone of its kind, holds the plugin's states, and clips no force.
void CheckActuator(const mjModel* m, int actuator, const JointFriction& friction);

/// Throws BadInput where another friction acts on the joint of a passive instance: two would be one that
/// is stiffer than the step can carry.
void CheckAlone(const mjModel* m, int instance, int joint);

}  // namespace warmjoint
