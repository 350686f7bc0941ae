// The one way by which friction is put onto the joints of a model: which joints bear it, and its sections as MJCF text.
#pragma once

#include <mujoco/mujoco.h>
#include <warmjoint/attach.h>
#include <warmjoint/friction.h>

#include <string>
#include <vector>

#include "models/foundation/bad_input.h"
#include "sim/plugin/stability.h"

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
/// viscous: by_damping where each joint's damping is its friction's viscous already.
/// What else would act as friction, or clip it, is the caller's to remove: see ClearOwnFriction, ClearPlasticSpring.
void AddFriction(mjSpec& spec, const std::vector<FrictionForJoint>& frictions, const Place& place,
                 const AttachOptions& options = {}, Viscous viscous = Viscous::by_plugin);

/// Adds an array of the model, "INSTANCE/NUMBER", for each number that the frictions have, and for the heat at a reset. viscous: by_damping where
/// it is the joint's damping, and has no array.
void AddNumbers(mjSpec& spec, const std::vector<FrictionForJoint>& frictions,
                const std::string& instance, Viscous viscous);

/// Whether servos are too stiff for the model's integrator beside the friction, and implicitfast carries them (CheckDrive).
bool NeedsImplicitfast(const mjModel* m, const std::vector<FrictionForJoint>& frictions);

/// Takes from a joint the friction that the model gives it: damping and frictionloss.
/// Returns whether there was any.
bool ClearOwnFriction(mjsJoint& joint);

/// Takes from a joint the stiffness of a spring that yields (`springyield`, MuJoCo 4.0), which resists as dry friction does: up to
/// stiffness times yield in either direction, N.m or N. Returns whether there was one.
bool ClearPlasticSpring(mjsJoint& joint);

/// Refuses, from `place` and with one remedy for all, joints whose inertia cannot carry their
/// friction at the model's step: the armature to set on each of them (`attach --armature`), and the
/// step that would do for all (`--timestep`). Both are rounded to two digits to the safe side, so that
/// either is accepted.
/// m: the model without the friction. An armature a adds exactly a to the effective inertia of its
/// own joint at the reference pose, and lowers that of no other.
void RefuseLightJoints(const mjModel* m, const std::vector<FrictionForJoint>& frictions,
                       const Place& place);

/// How joints hold, one sentence each: which gives way most before it slides, with the armatures that
/// bring all to 5 mrad (0.5 mm), damping that the model leaves out or its integrator takes explicitly
/// (CheckDamping), and drives beside which a joint may not rest (CheckDrive). m: as above, with the joints'
/// viscous as their damping; stiffest_drive: of a program's own code.
std::vector<std::string> NoticesOfHolding(const mjModel* m,
                                          const std::vector<FrictionForJoint>& frictions,
                                          double stiffest_drive);

/// The sections <extension> and <actuator> that put friction onto a joint through the plugin,
/// attributes inline, as MJCF text. The actuator is named "JOINT_friction". Of the options, stiffest_drive
/// counts.
std::string FrictionSections(const FrictionForJoint& friction, const AttachOptions& options = {},
                             Viscous viscous = Viscous::by_plugin);

/// The section <extension> with one instance of that name which holds the friction of all the
/// joints, and its own name, from which the plugin finds what an attachment put before the names.
/// Of the options, sensors and stiffest_drive count.
std::string InstanceSection(const std::string& instance,
                            const std::vector<FrictionForJoint>& frictions,
                            const AttachOptions& options, Viscous viscous = Viscous::by_plugin);

/// Name of the actuator that carries the friction of a joint.
std::string FrictionActuatorOf(const std::string& joint);

}  // namespace warmjoint
