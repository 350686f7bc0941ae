// Forces within the levels of friction that are nearest to others.
#pragma once

#include <mujoco/mujoco.h>

#include <vector>

#include "sim/plugin/inertia_block.h"

namespace warmjoint::inline sim {

/// Projection of forces onto a box, in the metric of the inverse inertia matrix of one tree:
///   force = argmin (x - aim)' M^-1 (x - aim),  -lower <= x <= upper
/// which is a linear complementarity problem: slip = M^-1 (aim - force) is 0 where force is within
/// its bounds, and does not point away from the bound that it is at. With S what slips,
///   slip_S = M_SS^-1 (aim - bound)_S,   force = aim - M slip
/// S is right where no slip points away and no other force is out of bounds. As long as fewer are
/// wrong than before all of those change, else the last of them (Judice and Pires, Computers and
/// Operations Research 21 (1994)). Keeps S, so that a problem near the last takes one turn.
class BoxProjection {
 public:
  /// What a degree of freedom does: is at a bound, within them, or bound to 0 and free to slip.
  enum Course : signed char { at_lower = -1, within = 0, at_upper = 1, free = 2 };

  BoxProjection() = default;
  explicit BoxProjection(int size);

  /// Begins with `course`.
  void Start(InertiaBlock& inertia, const mjData* d);

  /// Finds force and slip from aim, lower, upper and course.
  void Find(InertiaBlock& inertia, const mjData* d);

  // [size] each
  std::vector<Course> course;
  std::vector<double> lower, upper;  // N.m or N, not negative
  std::vector<double> aim, force;    // N.m or N
  std::vector<double> slip;          // in the unit of M^-1 force

 private:
  double Bound(size_t i) const;
  Course Better(size_t i) const;
  int Count() const;
  void Turn(bool all);

  std::vector<char> slips_;
};

}  // namespace warmjoint::inline sim
