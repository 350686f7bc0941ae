// Columns of the inverse inertia matrix of one tree, those that a step asks for.
#pragma once

#include <mujoco/mujoco.h>

#include <array>
#include <span>
#include <vector>

#include "sim/plugin/inertia_block.h"
#include "sim/plugin/row_pairs.h"

namespace warmjoint::inline sim {

/// What M^-1 makes of one vector of forces, and of forces of 1 at single joints, by the engine's own
/// factors of M, which take two vectors at once.
class InverseColumns {
 public:
  /// So many columns are kept.
  static constexpr int kMost = 6;

  InverseColumns() = default;
  /// size: of the tree.
  explicit InverseColumns(size_t size);

  /// Begins a step: solves for the forces kFriction of all rows, N.m or N, and for the column of the
  /// joint that needs one soonest.
  void Start(const InertiaBlock& inertia, const mjData* d, Rows rows, int likely);

  /// M^-1 of those forces until Add, two rows at once.
  Two bearing(size_t k) const { return {solved_[2 * k][0], solved_[2 * k + 1][0]}; }

  /// The place of a joint's column; -1 where it is not there.
  int Find(int joint) {
    // the first question is when a column is needed at all
    if (count_ == 0) Keep(likely_, 1);
    int place = count_ - 1;
    while (place >= 0 && joints_[place] != joint) --place;
    return place;
  }

  /// Adds the columns of joints that have none, in their order; false, and nothing done, where they do
  /// not fit in.
  bool Add(const InertiaBlock& inertia, const mjData* d, std::span<const int> joints);

  int count() const { return count_; }

  /// Two rows at once.
  const Two* operator[](int place) const { return columns_.data() + place * pairs_; }

 private:
  void Keep(int joint, int lane);

  size_t pairs_ = 0;
  std::vector<Two> solved_;   // of each row: two vectors
  std::vector<Two> columns_;  // [kMost][pairs]
  std::array<int, kMost> joints_{};
  int count_ = 0;
  int likely_ = 0;  // the joint whose column Start has solved for
};

}  // namespace warmjoint::inline sim
