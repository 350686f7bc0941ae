// How stiff and how damped the bristles of coupled joints are.
#pragma once

#include "models/friction/bristle.h"

namespace warmjoint::inline sim {

/// Stiffness A and damping B of the bristles, in units of M/h^2 and M/h.
struct BristleShape {
  double stiffness = 0;
  double damping = 0;
};

/// Of an instance that is alone on its kinematic tree: every mode of the held joints, each with
/// eigenvalue 1, follows z^2 - (2 - A - B) z + 1 - B = 0, whose roots are 0.45 in size.
inline constexpr BristleShape kLoneBristles{0.8, 0.8};

/// Of so many instances that share a tree, each of which takes the others' joints as free: the
/// eigenvalues are then at most their number, and A + 2 B = 3.6 over it keeps the step stable. Over
/// the poses of arms with six and seven axes they are at most 3.3, however many instances.
inline BristleShape BristlesOf(int instances) {
  if (instances <= 1) return kLoneBristles;
  if (instances > 4) return {kBristleStiffness, kBristleDamping};
  return {1.2 / instances, 1.2 / instances};
}

/// Damping of RK4, beside that of integrators which ask for the force once a step: its stages see
/// speeds that the damper has slowed, so that a mode follows
///   v' = -(A + B + D) v/h - A z/h^2,   z' = z + h v of the last stage
/// by the method's polynomial, D h/M being what other damping adds, which this integrator takes
/// explicitly, too. Its spectral radius is below 0.6 for B + D from 0.05 to 0.69, and 0.56 at both
/// B alone and B + 0.5, which is what the joints' own damping adds at 5 ms in poses of arms without armature.
inline constexpr double kDampingOfStages = 0.1875;

}  // namespace warmjoint::inline sim
