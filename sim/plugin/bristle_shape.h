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

/// Of instances that share one, each of which takes the others' joints as free: the eigenvalue is
/// then at most the number of instances, 3.3 over the poses of arms with six and seven.
inline constexpr BristleShape kSharedBristles{kBristleStiffness, kBristleDamping};

/// shared: the joint's tree, with another instance.
inline const BristleShape& BristlesOf(bool shared) {
  return shared ? kSharedBristles : kLoneBristles;
}

}  // namespace warmjoint::inline sim
