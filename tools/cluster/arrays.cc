#include "tools/cluster/arrays.h"

#include <fmt/format.h>

#include <algorithm>

namespace warmjoint::inline tools {

std::string Ranges(const std::vector<int>& ascending, const char* comma) {
  std::vector<std::string> ranges;
  for (std::size_t i = 0; i < ascending.size();) {
    // from one number to the last that follows it without a hole
    std::size_t last = i;
    while (last + 1 < ascending.size() && ascending[last + 1] == ascending[last] + 1) ++last;
    ranges.push_back(last == i ? std::to_string(ascending[i])
                               : fmt::format("{}-{}", ascending[i], ascending[last]));
    i = last + 1;
  }
  return fmt::format("{}", fmt::join(ranges, comma));
}

std::vector<JobArray> ArraysOf(const std::vector<int>& shards, int most_indices, int parallelism) {
  std::vector<JobArray> arrays;
  // one array for each block of `most_indices` numbers
  for (const int number : shards) {
    const int offset = (number - 1) / most_indices * most_indices;
    if (arrays.empty() || arrays.back().offset != offset) arrays.push_back({offset, "", {}});
    arrays.back().shards.push_back(number);
  }

  // the tasks at a time are parted evenly, at least one for each array
  const int each = arrays.empty() ? 0 : parallelism / static_cast<int>(arrays.size());
  for (JobArray& array : arrays) {
    std::vector<int> indices;
    for (const int number : array.shards) indices.push_back(number - 1 - array.offset);
    array.indices = Ranges(indices, ",");
    if (parallelism > 0) array.indices += fmt::format("%{}", std::max(1, each));
  }
  return arrays;
}

}  // namespace warmjoint::inline tools
