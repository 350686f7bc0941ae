// A part of a run, for one of several machines.
#pragma once

#include <string>

#include "tools/store/result.h"

namespace warmjoint::inline tools {

/// Every count-th realization from `index` on (all variants of each), so that shards are alike.
/// The default is the whole.
struct Shard {
  int index = 1;  // from 1
  int count = 1;

  bool Holds(Unit unit) const { return unit.realization % count == index - 1; }
};

/// Reads "i/n", 1 <= i <= n. Throws BadInput for anything else.
Shard ReadShard(const std::string& text);

}  // namespace warmjoint::inline tools
