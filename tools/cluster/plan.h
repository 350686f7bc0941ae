// A run in shards: how it is parted, and where its files lie.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenarios/suite.h"

namespace warmjoint {

/// RUN/slurm holds the plan: plan.json (the number of shards), suite.yaml (fully resolved), array.sbatch
/// and log. RUN/shards/NUMBER/results.sqlite is a finished shard.
struct Plan {
  std::filesystem::path run;  // absolute
  std::string suite_yaml;
  Suite suite;
  int shards = 1;

  std::filesystem::path folder() const { return run / "slurm"; }
  std::filesystem::path suite_file() const { return folder() / "suite.yaml"; }
  std::filesystem::path script() const { return folder() / "array.sbatch"; }

  /// Where the results of a shard come to lie. number: from 1.
  std::filesystem::path Results(int number) const;
  bool IsDone(int number) const { return std::filesystem::exists(Results(number)); }
  bool IsMerged() const { return std::filesystem::exists(run / "results.sqlite"); }

  /// Units (realizations of all variants) of a shard.
  int Units(int number) const;
  /// Numbers of the shards without results.
  std::vector<int> Open() const;
};

bool HasPlan(const std::filesystem::path& run);

/// Throws BadInput where there is none.
Plan ReadPlan(const std::filesystem::path& run);

/// Writes suite.yaml and plan.json, of which the last makes the directory a planned run.
void WritePlan(const Plan& plan);

/// Shards of a suite where nobody says otherwise: 1000 realizations of one variant for each thread.
int DefaultShards(const Suite& suite, int jobs);

/// The command of shard `number`, which may be a shell's variable. more: what else `run` is told.
std::vector<std::string> ShardCommand(const Plan& plan, const std::string& number,
                                      const std::vector<std::string>& more);

/// "1-3, 7" of 1, 2, 3, 7. comma: what parts them.
std::string Ranges(const std::vector<int>& ascending, const char* comma = ", ");

}  // namespace warmjoint
