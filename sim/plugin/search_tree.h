// What holds and what slides in one tree, where nothing tells it beforehand.
#pragma once

#include <mujoco/mujoco.h>

#include <vector>

#include "sim/plugin/asked_levels.h"
#include "sim/plugin/box_projection.h"
#include "sim/plugin/inertia_block.h"
#include "sim/plugin/row_pairs.h"

namespace warmjoint::inline sim {

/// Both projections of CoupledBristles by a search for what slides. It begins with what has slid at the
/// last step, and its answer follows from what it ends with alone.
class SearchTree {
 public:
  SearchTree() = default;
  explicit SearchTree(int size) : box_(size), last_(box_.course) {}

  /// Finds kFriction, kLoad and kSliding of the joints' rows. force: {p where everything is held, M v} of
  /// each row; joints: rows with friction; damping: B/h.
  void Find(InertiaBlock& inertia, const mjData* d, Rows rows, AskedLevels& levels,
            const std::vector<int>& joints, const Two* force, double damping);

 private:
  void Take(Rows rows, const Two* force);

  BoxProjection box_;
  std::vector<BoxProjection::Course> last_;  // at the end of a step's first projection
};

}  // namespace warmjoint::inline sim
