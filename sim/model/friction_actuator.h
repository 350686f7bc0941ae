// The one way by which friction is put onto a joint of a model.
#pragma once

#include <mujoco/mujoco.h>

#include <string>
#include <vector>

#include "models/foundation/bad_input.h"
#include "models/friction/friction_description.h"

namespace warmjoint::inline sim {

/// Friction for one joint of a model.
struct FrictionForJoint {
  std::string joint;
  FrictionDescription friction;
};

/// The sections <extension> and <actuator> that put friction onto a joint through the plugin,
/// attributes inline, as MJCF text. The actuator is named "JOINT_friction".
std::string FrictionSections(const std::string& joint, const FrictionDescription& friction);

/// The joint of that name. Throws BadInput, from `place`, with the nearest name, where the model
/// lacks it.
mjsJoint* FindJoint(mjSpec& spec, const std::string& joint, const Place& place);

/// Adds the plugin's actuator for each joint, "JOINT_friction", after all other actuators, so that
/// the controls of those keep their places. frictions: checked here. Several share one instance of
/// the plugin, since each instance costs the engine time of its own in every step.
/// What else would act as friction, or clip it, is the caller's to remove: see ClearOwnFriction.
/// Throws BadInput from `place` for an unknown joint, one that is neither hinge nor slide, and one
/// that has such an actuator already.
void AddFriction(mjSpec& spec, const std::vector<FrictionForJoint>& frictions, const Place& place);

/// Takes from a joint the friction that the model gives it: damping and frictionloss.
/// Returns whether there was any.
bool ClearOwnFriction(mjsJoint& joint);

}  // namespace warmjoint::inline sim
