// What `run` and `merge` say of a run.
#pragma once

#include "tools/actions/run_task.h"
#include "tools/cli/command.h"

namespace warmjoint {

/// Whether a store holds all of a run, or a part of it that says little by itself.
enum class RunPart { whole, shard };

/// Prints what became of the results. Verdicts are results: a suite that ends in them alone is done. For
/// each identifier that never answered its first reason goes to stderr, and a whole run then ends with
/// status 5; of a shard, which may hold few realizations or none, only the whole says.
ExitStatus PrintEnding(const std::filesystem::path& directory, const RunEnding& ending,
                       RunPart part);

}  // namespace warmjoint
