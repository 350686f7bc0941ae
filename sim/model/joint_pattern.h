// Joints by name or by pattern.
#pragma once

#include <mujoco/mujoco.h>

#include <string>
#include <vector>

#include "models/foundation/bad_input.h"

namespace warmjoint::inline sim {

/// The joint of that name. Throws BadInput, from `place`, with the nearest name, where the model
/// lacks it.
mjsJoint* FindJoint(mjSpec& spec, const std::string& joint, const Place& place);

/// The joints that a name or a pattern means: the joint of that name alone where there is one, else
/// every hinge and slide joint whose whole name the pattern, a regular expression as in ECMAScript,
/// matches, in the order of the model. Throws BadInput, from `place`, where it means none.
std::vector<std::string> MatchJoints(mjSpec& spec, const std::string& pattern, const Place& place);

/// Number of hinges and slides without a name, which no pattern can mean.
int NamelessJoints(mjSpec& spec);

}  // namespace warmjoint::inline sim
