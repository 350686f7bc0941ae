// Shards that lie in a run's own folder, not merged yet.
#pragma once

#include <filesystem>
#include <vector>

namespace warmjoint::inline tools {

/// The folders in RUN/shards that hold results, by name; none where RUN was not planned as shards.
std::vector<std::filesystem::path> ShardsOf(const std::filesystem::path& run);

}  // namespace warmjoint::inline tools
