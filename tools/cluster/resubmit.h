// Starting again what a cluster lost.
#pragma once

#include <filesystem>
#include <vector>

namespace warmjoint::inline tools {

/// Submits the shards that are missing or failed and neither wait nor run, with their starts counted from
/// 0 again; their numbers. pieces: in how many shards what is open of each is parted; the finished part
/// stays a shard of its own. Throws BadInput where Slurm does not answer: a shard that is at work must
/// not be taken for lost.
std::vector<int> Resubmit(const std::filesystem::path& run, int pieces);

}  // namespace warmjoint::inline tools
