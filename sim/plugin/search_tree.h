// What holds and what slides in one tree, where nothing tells it beforehand.
#pragma once

#include <mujoco/mujoco.h>

#include <vector>

#include "sim/plugin/asked_levels.h"
#include "sim/plugin/box_projection.h"
#include "sim/plugin/inertia_block.h"
#include "sim/plugin/row_pairs.h"

namespace warmjoint::inline sim {

/// Both projections of CoupledBristles by a search for what slides.
class SearchTree {
 public:
  SearchTree() = default;
  explicit SearchTree(int size) : box_(size) {}

  /// Finds kFriction, kLoad and kSliding of the joints' rows. force: {p, f} of each row where everything is held,
  /// N.m or N; impulse: A/h; joints: rows with friction.
  void Find(InertiaBlock& inertia, const mjData* d, Rows rows, AskedLevels& levels,
            const std::vector<int>& joints, const Two* force, double impulse);

 private:
  void Guess(const InertiaBlock& inertia, const mjData* d, Rows rows, const Two* force,
             double impulse);

  BoxProjection box_;
};

}  // namespace warmjoint::inline sim
