// warmjoint run --slurm, --local-shards: a suite as many tasks.
#pragma once

#include <CLI/CLI.hpp>

#include "tools/actions/run_arguments.h"
#include "tools/cli/command.h"

namespace warmjoint::inline tools {

/// The options of a run in shards.
void AddShardOptions(CLI::App& parser, RunArguments& arguments);

/// Refuses options of a run in shards where it is none.
void RefuseShardOptions(const RunArguments& arguments);

/// Plans the run, or takes the plan that is there, and submits it or carries it out.
ExitStatus RunInShards(const RunArguments& arguments);

}  // namespace warmjoint::inline tools
