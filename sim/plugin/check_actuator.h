// Whether an actuator of the model can carry friction.
#pragma once

#include <mujoco/mujoco.h>

#include <algorithm>
#include <string>

#include "models/friction/joint_friction.h"

namespace warmjoint::inline sim {

/// "actuator 'name'" or "actuator 3", for messages.
std::string ActuatorName(const mjModel* m, int actuator);

/// The name of the first actuator of a plugin instance, for messages.
std::string InstanceName(const mjModel* m, int instance);

/// Effective inertia of a degree of freedom at the reference pose with all the others free,
/// 1 / dof_invweight0, kg.m^2 or kg; 0 while the compiler has not yet determined it.
inline double EffectiveInertia(const mjModel* m, int dof) {
  const double inverse = m->dof_invweight0[dof];
  return inverse > 0 ? 1 / inverse : 0;
}

/// Effective inertia at the present pose, kg.m^2 or kg: the smaller of the one at the reference
/// pose and the joint's pivot in the factorised inertia matrix, which sees the present pose but
/// takes the joints before it as held. Over the poses of arms with 6 and 7 axes the inertia matrix
/// scaled by these has eigenvalues up to 3.3; with reference values alone, up to 28.
inline double EffectiveInertia(const mjModel* m, const mjData* d, int dof) {
  const double inverse = std::max(m->dof_invweight0[dof], d->qLDiagInv[dof]);
  return inverse > 0 ? 1 / inverse : 0;
}

/// Throws BadInput, naming actuator, property, value and remedy, unless the actuator drives a
/// hinge or slide joint directly, holds the plugin's states, clips no force, and the engine's step
/// and integrator can carry the friction.
void CheckActuator(const mjModel* m, int actuator, const JointFriction& friction);

}  // namespace warmjoint::inline sim
