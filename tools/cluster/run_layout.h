// Where the files of a planned run lie.
#pragma once

#include <fmt/format.h>

#include <filesystem>

namespace warmjoint::inline tools {

/// RUN/slurm: plan, scripts, logs, and what was submitted.
inline std::filesystem::path PlanFolder(const std::filesystem::path& run) { return run / "slurm"; }

inline std::filesystem::path PlanFile(const std::filesystem::path& run) {
  return PlanFolder(run) / "plan.json";
}

/// The folder of a shard: its results so far and its state. number: from 1.
inline std::filesystem::path ShardFolder(const std::filesystem::path& run, int number) {
  return run / "shards" / fmt::format("{:06}", number);
}

}  // namespace warmjoint::inline tools
