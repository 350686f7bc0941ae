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

  /// What bristles add to an acceleration for each unit of speed: A/h and B/h.
  struct PerSpeed {
    double impulse, damping;
  };

  /// Finds kFriction, kLoad and kSliding of the joints' rows. force: {p where everything is held, M v} of
  /// each row; joints: rows with friction.
  void Find(InertiaBlock& inertia, const mjData* d, Rows rows, AskedLevels& levels,
            const std::vector<int>& joints, const Two* force, const PerSpeed& per_speed);

 private:
  void Guess(const InertiaBlock& inertia, const mjData* d, Rows rows, const Two* force,
             double impulse);

  BoxProjection box_;
};

}  // namespace warmjoint::inline sim
