// What friction the engine's step can carry: how stiff bristles are, on which inertia, beside which drives.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "models/foundation/bad_input.h"
#include "models/friction/bristle.h"
#include "models/friction/joint_friction.h"

namespace warmjoint {

/// Stiffness A and damping B of the bristles, in units of M/h^2 and M/h.
struct BristleShape {
  double stiffness = 0;
  double damping = 0;
};

/// The largest eigenvalue of the inverse inertia matrix scaled by the joints' inertias, over the poses
/// of arms with six and seven axes.
inline constexpr double kLargestCoupling = 3.3;

/// Of an instance that is alone on its kinematic tree: every mode of the held joints, each with
/// eigenvalue 1, follows z^2 - (2 - A - B) z + 1 - B = 0 with the double root r = 0.2, A = (1 - r)^2 and
/// B = 1 - r^2, so that a load that jumps stretches a bristle to what it asks and not beyond.
inline constexpr BristleShape kLoneBristles{0.64, 0.96};

/// The damper of a bristle that is within its levels gives up to so many times them. Why: a load that jumps
/// by a level asks for A + B = 1.6 of it in the first step, and one from level to level for little more.
inline constexpr double kDamperLevels = 2;

/// Of so many instances that share a tree, each of which takes the others' joints as free: the
/// eigenvalues are then at most their number, and A + 2 B = 3.6 over it keeps the step stable; they are
/// at most kLargestCoupling, however many instances.
inline BristleShape BristlesOf(int instances) {
  if (instances <= 1) return kLoneBristles;
  if (instances > 4) return {kBristleStiffness, kBristleDamping};
  return {1.2 / instances, 1.2 / instances};
}

/// Of A + 2 B, times those eigenvalues, and K + 2 C of drives the step carries less than 4.
inline constexpr double kCarried = 3.9;

/// K + 2 C (StiffestDrives) beside which bristles still hold; frictionloss lets joints rest to there.
inline constexpr double kStiffestDrive = 3;

/// A slope of friction over speed that the step can carry takes at most so much of the damping.
inline constexpr double kMostSlope = 0.5;

/// Whether drives of that K + 2 C leave bristles nothing of what the step carries.
inline bool ShakesBeside(double drive) { return drive + kCarried - kStiffestDrive >= 4; }

/// Beside drives of that K + 2 C: as above where the step carries both, else softer, with A = 2 B at last.
/// slope: of friction over speed that the step takes explicitly, in units of M/h, which damps already, up to kMostSlope;
/// damping: share of B that the integrator carries.
inline BristleShape BristlesOf(int instances, double drive, double slope = 0, double damping = 1) {
  const BristleShape alone = BristlesOf(instances);
  slope = std::min(slope, kMostSlope);
  const BristleShape own{alone.stiffness * (1 - slope),
                         std::max(0.0, damping * alone.damping - slope)};
  const double left = kCarried - std::min(drive, kStiffestDrive);
  const double carried = left / std::min<double>(instances, kLargestCoupling);
  if (drive <= 0 || own.stiffness + 2 * own.damping <= carried) return own;
  const double stiffness = std::min(own.stiffness, carried / 2);
  return {stiffness, (carried - stiffness) / 2};
}

/// Damping of RK4, beside that of integrators which ask for the force once a step: its stages see
/// speeds that the damper has slowed, so that a mode follows
///   v' = -(A + B + D) v/h - A z/h^2,   z' = z + h v of the last stage
/// by the method's polynomial, D h/M being what other damping adds, which this integrator takes
/// explicitly, too. Its spectral radius is below 0.6 for B + D from 0.24 to 0.75, and so at both B alone and
/// B + 0.5, which is what the joints' own damping adds at 5 ms in poses of arms without armature.
inline constexpr double kDampingOfStages = 0.255;

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

/// The laws' slope over speed.
inline constexpr char kViscousName[] = "viscous";

/// Who adds the constant part of friction's slope over speed, kv.
enum class Viscous { by_plugin, by_damping };

/// A joint's friction as the step sees it.
struct SteppedFriction {
  const JointFriction& friction;
  Viscous viscous = Viscous::by_plugin;
  double inertia = 0;  // effective, kg.m^2 or kg

  /// The slope of the plugin's own force over speed, at most, N.m.s/rad or N.s/m.
  double OwnSlope() const {
    return friction.SteepestSlope() - (viscous == Viscous::by_damping ? friction.viscous() : 0);
  }
};

/// Whether an integrator takes the joints' damping implicitly, in a model with these flags.
bool DampsImplicitly(const mjModel* m, int integrator);

/// The slope over speed that the model's step takes explicitly, at most, N.m.s/rad or N.s/m.
inline double ExplicitSlope(const mjModel* m, const SteppedFriction& joint) {
  const bool own = DampsImplicitly(m, m->opt.integrator);
  return own ? joint.OwnSlope() : joint.friction.SteepestSlope();
}

/// What the step asks of a joint's inertia so that it carries the friction.
struct Asked {
  double inertia;   // at least, kg.m^2 or kg
  double timestep;  // s, or else at most this step
  std::string why;
};

/// For the slope over speed that the plugin adds, and for the bristle.
std::array<Asked, 2> AskedOf(const mjModel* m, int joint, const SteppedFriction& friction,
                             const BristleShape& bristles);

/// Throws BadInput, from `place` and with the remedy, unless the joint is a hinge or slide whose
/// effective inertia lets the model's step carry the friction. bristles: those of a law that leaves them
/// to the step, as they are without drives.
void CheckJoint(const mjModel* m, int joint, const SteppedFriction& friction,
                const BristleShape& bristles, const Place& place);

/// Throws BadInput, from `place` and with the remedies, where the model's flags leave the joint without
/// the damping that is friction's viscous, or its integrator takes it explicitly and it is too steep.
void CheckDamping(const mjModel* m, int joint, const SteppedFriction& friction, const Place& place);

/// Throws BadInput, from `place` and with the remedies, where the drives of a joint's tree
/// (StiffestDrives) leave bristles nothing of what the step carries. slopes: as there.
void CheckDrive(const mjModel* m, int joint, double drive, const std::vector<double>& slopes,
                const Place& place);

/// Of each kinematic tree, the largest eigenvalue of M^-1 (h^2 K + 2 h C) over poses under an integrator:
/// K is the stiffness of affine drives of joints and of the joints' own springs, C the damping of the
/// drives and joints and `slopes`, of each degree of freedom what the plugin adds (OwnSlope), N.m.s/rad or
/// N.s/m. Damping that the integrator takes implicitly counts as -C. 0 under `discrete` and RK4, which carry
/// more stiffness than bristles need, and where all is so soft that BristlesOf does not change.
std::vector<double> StiffestDrives(const mjModel* m, int integrator,
                                   const std::vector<double>& slopes);

/// The largest eigenvalue of M^-1 times a diagonal. added: [n], kg.m^2 or kg; inertia: M [n x n].
double StiffestMode(const Eigen::VectorXd& added, const Eigen::MatrixXd& inertia);

/// Shows the inertia matrix [nv x nv] in the reference pose and in others within the joints' ranges, the same ones for each model.
void OverPoses(const mjModel* m, const std::function<void(const Eigen::MatrixXd& inertia)>& look);

}  // namespace warmjoint
