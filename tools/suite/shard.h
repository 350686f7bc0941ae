// A part of a run, for one of several machines.
#pragma once

#include <limits>
#include <string>

#include "tools/store/result.h"

namespace warmjoint::inline tools {

/// Every count-th realization from `index` on, of those from `first` up to `end` (all variants of each).
/// The default is the whole.
struct Shard {
  int index = 1;  // from 1
  int count = 1;
  int first = 0;
  int end = std::numeric_limits<int>::max();  // one beyond the last

  bool Holds(Unit unit) const {
    return first <= unit.realization && unit.realization < end &&
           unit.realization % count == index - 1;
  }
  bool IsWhole() const {
    return count == 1 && first == 0 && end == std::numeric_limits<int>::max();
  }
};

/// Reads "i/n", 1 <= i <= n: every n-th realization, so that shards are alike; or "a:b", a <= b:
/// realizations a to b - 1. Throws BadInput for anything else.
Shard ReadShard(const std::string& text);

}  // namespace warmjoint::inline tools
