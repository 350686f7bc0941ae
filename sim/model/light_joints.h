// Joints too light for their friction at a model's step.
#pragma once

#include <mujoco/mujoco.h>

#include <string>
#include <vector>

#include "models/foundation/bad_input.h"
#include "sim/model/friction_sections.h"

namespace warmjoint {

/// Refuses, from `place` and with one remedy for all, joints whose inertia cannot carry their
/// friction at the model's step: the armature to set on each of them (`attach --armature`), and the
/// step that would do for all (`--timestep`). Both are rounded to two digits to the safe side, so that
/// either is accepted.
/// m: the model without the friction. An armature a adds exactly a to the effective inertia of its
/// own joint at the reference pose, and lowers that of no other.
void RefuseLightJoints(const mjModel* m, const std::vector<FrictionForJoint>& frictions,
                       const Place& place);

/// How joints hold, one sentence each: which gives way most before it slides, with the armatures that
/// bring all to 5 mrad (0.5 mm), and drives beside which a joint may not rest (CheckDrive). m: as above.
std::vector<std::string> NoticesOfHolding(const mjModel* m,
                                          const std::vector<FrictionForJoint>& frictions);

}  // namespace warmjoint
