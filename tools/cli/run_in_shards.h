// warmjoint run --slurm, --local-shards: a suite in shards.
#pragma once

#include <CLI/CLI.hpp>

#include "tools/actions/run_task.h"
#include "tools/cli/command.h"

namespace warmjoint {

/// The options of a run in shards.
void AddShardOptions(CLI::App& parser, RunArguments& arguments);

/// Refuses options of a run in shards where it is none.
void RefuseShardOptions(const RunArguments& arguments);

/// Plans the run, or takes the plan that is there, and submits it or carries it out.
ExitStatus RunInShards(const RunArguments& arguments);

/// One shard of a planned run, as its tasks do it: on this machine's own disk (TMPDIR), and into RUN once
/// it is finished. One that is interrupted or killed leaves nothing and begins anew.
ExitStatus RunPlannedShard(const RunArguments& arguments, const RunTask& task);

}  // namespace warmjoint
