// Whether an actuator of the model can carry friction.
#pragma once

#include <mujoco/mujoco.h>

#include <string>

#include "models/friction/joint_friction.h"

namespace warmjoint::inline sim {

/// "actuator 'name'" or "actuator 3", for messages.
std::string ActuatorName(const mjModel* m, int actuator);

/// The name of the first actuator of a plugin instance, for messages.
std::string InstanceName(const mjModel* m, int instance);

/// Throws BadInput, naming actuator, property, value and remedy, unless the actuator drives a
/// joint directly and alone of its kind, holds the plugin's states, and clips no force.
void CheckActuator(const mjModel* m, int actuator, const JointFriction& friction);

}  // namespace warmjoint::inline sim
