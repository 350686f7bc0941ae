#include "tools/store/shards_of.h"

#include <algorithm>

namespace warmjoint::inline tools {
namespace fs = std::filesystem;

std::vector<fs::path> ShardsOf(const fs::path& run) {
  // folders in which a task has put results
  std::vector<fs::path> shards;
  if (!fs::is_directory(run / "shards")) return shards;
  for (const auto& entry : fs::directory_iterator(run / "shards")) {
    if (fs::exists(entry.path() / "results.sqlite")) shards.push_back(entry.path());
  }
  std::sort(shards.begin(), shards.end());
  return shards;
}

}  // namespace warmjoint::inline tools
