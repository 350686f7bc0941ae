// What the command line asks of a run.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scenarios/suite.h"
#include "tools/suite/sandbox.h"

namespace warmjoint::inline tools {

/// Most threads of a run.
inline constexpr int kMostJobs = 1024;

struct RunArguments {
  std::string suite;
  std::string output;
  std::optional<std::uint64_t> jobs;
  std::optional<std::uint64_t> realizations;
  std::optional<std::uint64_t> seed;
  std::vector<std::string> identifiers;
  std::string shard = "1/1";
  bool keep = false;
  bool allow_commands = false;
  Confinement confinement = Confinement::sandbox;  // of commands

  // of a run in shards
  bool slurm = false;
  std::optional<std::uint64_t> local_shards;  // processes on this machine
  std::optional<std::uint64_t> shards;
  std::vector<std::string> sbatch;  // key=value
  bool dry_run = false;

  bool in_shards() const { return slurm || local_shards; }
};

/// The suite with what the command line changes. Throws BadInput for a command that the suite brings
/// along and nobody has agreed to.
Suite ResolveSuite(const RunArguments& arguments);

}  // namespace warmjoint::inline tools
