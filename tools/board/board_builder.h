// A leaderboard of results that come unit by unit.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "tools/board/leaderboard.h"
#include "tools/board/sum_up.h"

namespace warmjoint::inline tools {

/// All identifiers over the units of one variant.
struct GroupColumns {
  GroupColumns(const Suite& suite, const std::shared_ptr<NumberFile>& file);

  int units = 0;
  MeanSquare bound_continuous, bound_discrete;  // NPE at the Cramer-Rao bound, once a unit
  std::vector<IdentifierColumns> identifiers;   // in the suite's order

  /// Adds those of a group that comes after this one.
  void Add(const GroupColumns& other);
};

/// Sums up a suite as its results come, in the order of (variant, realization). Memory does not grow with
/// their number; numbers lie in a temporary file, 64 bytes for each result.
class BoardBuilder {
 public:
  explicit BoardBuilder(Suite suite);

  /// The results of one unit.
  void Add(std::span<const Result> unit);

  Leaderboard Finish() const;

 private:
  GroupColumns All() const;

  Suite suite_;
  std::shared_ptr<NumberFile> file_ = std::make_shared<NumberFile>();
  std::vector<GroupColumns> groups_;  // by variant
};

}  // namespace warmjoint::inline tools
