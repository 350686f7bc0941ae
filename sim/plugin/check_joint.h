// Whether the engine's step can carry the friction of a joint.
#pragma once

#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <string>

#include "models/foundation/bad_input.h"
#include "models/friction/joint_friction.h"
#include "sim/plugin/bristle_shape.h"

namespace warmjoint::inline sim {

/// "joint 'name'" or "joint 3", for messages.
std::string JointName(const mjModel* m, int joint);

/// Effective inertia of a degree of freedom at the reference pose with all the others free,
/// 1 / dof_invweight0, kg.m^2 or kg; 0 while the compiler has not yet determined it. Of one that
/// MuJoCo knows to be uncoupled (simple) dof_invweight0 lacks the armature, and dof_M0 has it.
inline double EffectiveInertia(const mjModel* m, int dof) {
  if (m->dof_simplenum[dof] > 0) return m->dof_M0[dof];
  const double inverse = m->dof_invweight0[dof];
  return inverse > 0 ? 1 / inverse : 0;
}

/// Effective inertia at the present pose, kg.m^2 or kg: the smaller of the one at the reference
/// pose and the joint's pivot in the factorised inertia matrix, which sees the present pose but
/// takes the joints before it as held. Over the poses of arms with 6 and 7 axes the inertia matrix
/// scaled by these has eigenvalues up to 3.3; with reference values alone, up to 28.
inline double EffectiveInertia(const mjModel* m, const mjData* d, int dof) {
  const bool coupled = m->dof_simplenum[dof] == 0;
  const double inverse =
      coupled ? std::max(m->dof_invweight0[dof], d->qLDiagInv[dof]) : d->qLDiagInv[dof];
  return inverse > 0 ? 1 / inverse : 0;
}

/// What the step asks of a joint's inertia so that it carries the friction.
struct Asked {
  double inertia;   // at least, kg.m^2 or kg
  double timestep;  // s, or else at most this step
  std::string why;
};

/// For the slope over speed, and for the bristle.
std::array<Asked, 2> AskedOf(const mjModel* m, int joint, const JointFriction& friction,
                             const BristleShape& bristles);

/// Throws BadInput, from `place` and with the remedy, unless the joint is a hinge or slide whose
/// effective inertia at the reference pose lets the model's step carry the friction. bristles: those
/// of a law that leaves them to the step, as they are without drives.
void CheckJoint(const mjModel* m, int joint, const JointFriction& friction,
                const BristleShape& bristles, const Place& place);

/// Throws BadInput, from `place` and with the remedies, where the drives of a joint's tree
/// (StiffestDrives) leave bristles nothing of what the step carries.
void CheckDrive(const mjModel* m, int joint, double drive, const Place& place);

}  // namespace warmjoint::inline sim
