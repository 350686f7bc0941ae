// Levels of friction that cost much to know, and are found out where a step needs them.
#pragma once

#include <algorithm>
#include <vector>

#include "sim/plugin/row_pairs.h"

namespace warmjoint::inline sim {

/// Tells the levels of rows that ask for theirs.
class LevelSource {
 public:
  virtual ~LevelSource() = default;
  /// L+ for side 1 and L- for side -1, N.m or N; a level below 0 counts as 0.
  virtual double LevelAt(size_t row, int side) const = 0;
};

/// The levels kUpper and kLower of the rows of one tree: of most known at the beginning of a step, of
/// those that ask only from the moment on when somebody needs that side.
class AskedLevels {
 public:
  AskedLevels() = default;
  /// size: of the tree; asking: its rows that ask.
  AskedLevels(size_t size, std::vector<int> asking) : asking_(std::move(asking)) {
    known_.assign(size, kBoth);
  }

  const std::vector<int>& asking() const { return asking_; }

  /// Begins a step: nothing is known of those that ask, and a side that nothing asks for is 0. first:
  /// the tree's first row, of those of the source.
  void Begin(const LevelSource& source, size_t first, Rows rows) {
    source_ = &source;
    first_ = first;
    rows_ = rows;
    for (const int i : asking_) {
      known_[static_cast<size_t>(i)] = 0;
      const Row row = rows_.row(i);
      row[kUpper] = row[kLower] = 0;
    }
  }

  /// The level of a side; finds it out where it was not yet asked for.
  double Of(int i, int side) {
    double& level = rows_.row(i)[side > 0 ? kUpper : kLower];
    unsigned char& known = known_[static_cast<size_t>(i)];
    const unsigned char bit = side > 0 ? 2 : 1;
    if (known & bit) [[likely]]
      return level;
    known |= bit;
    return level = std::max(0.0, source_->LevelAt(first_ + static_cast<size_t>(i), side));
  }

 private:
  static constexpr unsigned char kBoth = 3;

  std::vector<int> asking_;
  std::vector<unsigned char> known_;  // sides whose level is known: 1 below, 2 above
  const LevelSource* source_ = nullptr;
  size_t first_ = 0;
  Rows rows_{nullptr};
};

}  // namespace warmjoint::inline sim
