// Forces within the levels of friction that are nearest to others.
#pragma once

#include <mujoco/mujoco.h>

#include <vector>

#include "sim/plugin/inertia_block.h"
#include "sim/plugin/row_pairs.h"

namespace warmjoint {

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
  enum Status : signed char { at_lower = -1, within = 0, at_upper = 1, free = 2 };

  BoxProjection() = default;
  explicit BoxProjection(int size);

  /// Begins with `status`.
  void Start(InertiaBlock& inertia, const mjData* d);

  /// Finds force and slip from aim, lower, upper and status.
  void Find(InertiaBlock& inertia, const mjData* d);

  // [size] each
  std::vector<Status> status;
  std::vector<double> lower, upper;  // N.m or N, not negative
  std::vector<double> aim, force;    // N.m or N
  std::vector<double> slip;          // in the unit of M^-1 force

 private:
  double Bound(size_t i) const;
  Status Better(size_t i) const;
  int Count() const;
  void Turn(bool all);

  std::vector<char> slips_;
};

/// Both projections of CoupledBristles by a search for what slides. It begins with what has slid at the
/// last step, and its answer follows from what it ends with alone.
class SearchTree {
 public:
  SearchTree() = default;
  explicit SearchTree(int size) : box_(size), last_(box_.status) {}

  /// Finds kFriction, kLoad and kSliding of the joints' rows. force: {p where everything is held, M v} of
  /// each row; joints: rows with friction; damping: B/h.
  void Find(InertiaBlock& inertia, const mjData* d, Rows rows, AskedLevels& levels,
            const std::vector<int>& joints, const Two* force, double damping);

 private:
  void Take(Rows rows, const Two* force);

  BoxProjection box_;
  std::vector<BoxProjection::Status> last_;  // at the end of a step's first projection
};

}  // namespace warmjoint
