// A part of a run, for one of several machines.
#pragma once

#include <cstdint>
#include <string>

namespace warmjoint {

inline constexpr int kMostShards = 1'000'000;

/// Part `index` (from 1) of `count`: a block of realizations, in all variants; the blocks follow one
/// another, and their sizes differ by 1 at most. The default is the whole.
struct Shard {
  int index = 1;
  int count = 1;

  /// Its first realization, and one beyond its last.
  int First(int realizations) const { return Shard{index - 1, count}.End(realizations); }
  int End(int realizations) const {
    return static_cast<int>(std::int64_t{index} * realizations / count);
  }

  bool IsWhole() const { return count == 1; }
};

/// Reads "i/n", 1 <= i <= n. Throws BadInput for anything else.
Shard ReadShard(const std::string& text);

}  // namespace warmjoint
