// How stiff and how damped the bristles of coupled joints are.
#pragma once

#include <algorithm>

#include "models/friction/bristle.h"

namespace warmjoint::inline sim {

/// Stiffness A and damping B of the bristles, in units of M/h^2 and M/h.
struct BristleShape {
  double stiffness = 0;
  double damping = 0;
};

/// The largest eigenvalue of the inverse inertia matrix scaled by the joints' inertias, over the poses
/// of arms with six and seven axes.
inline constexpr double kLargestCoupling = 3.3;

/// Of an instance that is alone on its kinematic tree: every mode of the held joints, each with
/// eigenvalue 1, follows z^2 - (2 - A - B) z + 1 - B = 0, whose roots are 0.45 in size.
inline constexpr BristleShape kLoneBristles{0.8, 0.8};

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

/// Beside drives of that K + 2 C: as above where the step carries both, else softer, with A = 2 B at last.
inline BristleShape BristlesOf(int instances, double drive) {
  const BristleShape own = BristlesOf(instances);
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
/// explicitly, too. Its spectral radius is below 0.6 for B + D from 0.05 to 0.69, and 0.56 at both
/// B alone and B + 0.5, which is what the joints' own damping adds at 5 ms in poses of arms without armature.
inline constexpr double kDampingOfStages = 0.1875;

}  // namespace warmjoint::inline sim
