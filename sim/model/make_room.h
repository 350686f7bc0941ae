// What acts on joints besides friction: what it replaces, what would clip it, what stays.
#pragma once

#include <mujoco/mujoco.h>
#include <warmjoint/attach.h>

#include <string>
#include <vector>

#include "models/foundation/bad_input.h"

namespace warmjoint {

/// Adds "NAMES: sentence" where there are any.
void Note(const std::vector<std::string>& names, const char* sentence,
          std::vector<std::string>& notices);

/// Takes away what friction replaces (the joints' damping, frictionloss and springs with a yield, the damping of their actuators) and, in the
/// actuator form, what would clip it; the joints' damping becomes the friction's viscous. Notes what was done, one
/// sentence each. frictions: of joints that exist, checked.
void MakeRoom(mjSpec& spec, const std::vector<FrictionForJoint>& frictions, FrictionForm form,
              const Place& place, std::vector<std::string>& notices);

/// What resists joints besides their friction and stays, a sentence for each joint: the friction of a dcmotor, and tendons
/// with frictionloss, damping or a spring with a yield whose length the joint changes. m: the model without the friction.
std::vector<std::string> NoticesOfOthers(const mjModel* m,
                                         const std::vector<FrictionForJoint>& frictions);

}  // namespace warmjoint
