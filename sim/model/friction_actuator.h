// The one way by which friction is put onto the joints of a model.
#pragma once

#include <mujoco/mujoco.h>
#include <warmjoint/attach.h>

#include <vector>

#include "models/foundation/bad_input.h"
#include "sim/model/friction_sections.h"

namespace warmjoint {

/// Throws BadInput from `place` for an unknown joint, one that is neither hinge nor slide, one that
/// is named twice, and a friction that makes no sense (CheckFriction).
void CheckJoints(mjSpec& spec, const std::vector<FrictionForJoint>& frictions, const Place& place);

/// Adds friction to each joint. frictions: checked here (CheckJoints); all joints share one instance of the
/// plugin, since each instance costs the engine time of its own in every step (one joint alone, as
/// an actuator, holds its attributes by itself). The actuators, "JOINT_friction", come after all
/// others, so that the controls of those keep their places; they take nothing from the model's
/// default classes. Of the options form, sensors and numbers count; sensors and arrays stand in the
/// order of `frictions`, which in the passive form must be the model's order of joints.
/// What else would act as friction, or clip it, is the caller's to remove: see ClearOwnFriction.
void AddFriction(mjSpec& spec, const std::vector<FrictionForJoint>& frictions, const Place& place,
                 const AttachOptions& options = {});

/// Takes from a joint the friction that the model gives it: damping and frictionloss.
/// Returns whether there was any.
bool ClearOwnFriction(mjsJoint& joint);

}  // namespace warmjoint
