// The friction that a model has by an earlier attach, which joins that of the next one.
#pragma once

#include <mujoco/mujoco.h>
#include <warmjoint/attach.h>

#include <vector>

namespace warmjoint {

/// Takes the friction that attach wrote before, in the form of the options, out of a spec, so that it can be written anew
/// together with other joints' (two instances on one kinematic tree would hold more softly than one). Left where it is:
/// what was written otherwise or for another form, what holds viscous in the plugin's own numbers, as attach wrote it up to
/// version 0.2, and what a prefix was put before. options: sensors, numbers and stiffest_drive become what either asks.
/// m: the spec as it compiles.
std::vector<FrictionForJoint> TakeEarlier(mjSpec& spec, const mjModel* m, AttachOptions& options);

/// Takes all friction of the plugin out of a spec: instances, and actuators, sensors, arrays and references of bodies to them. Joints keep
/// their damping.
void RemoveFriction(mjSpec& spec);

}  // namespace warmjoint
