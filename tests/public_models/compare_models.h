// What of a model attaching changed.
#pragma once

#include <mujoco/mujoco.h>

#include "sim/model/friction_actuator.h"

namespace warmjoint::test {

/// Number of the arrays of mjModel that differ, bit for bit, though attaching friction should leave
/// them alone: all but those of actuators, plugins, keyframes' act and ctrl, names and paths, and
/// the damping and frictionloss that the friction replaces; and, as actuators, what these change: the
/// effort limits of joints, whether trees sleep. Prints their names to stderr.
int CountChanges(const mjModel* before, const mjModel* after, FrictionForm form);

}  // namespace warmjoint::test
