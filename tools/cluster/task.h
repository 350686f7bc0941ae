// One task: a shard of a plan, from where it stands to its end.
#pragma once

#include <filesystem>

#include "tools/cluster/plan.h"

namespace warmjoint::inline tools {

enum class TaskEnd {
  done,         // the shard's results are in the run
  elsewhere,    // another task is at work on it
  interrupted,  // what is finished is kept; another task goes on
  failed,       // started too often without finishing a realization
};

/// Runs shard `number` (from 1) of the plan in RUN as a child of this process, in a folder on this
/// machine's own disk (TMPDIR), and copies what is finished into RUN at checkpoints and at the end.
/// Goes on from what an earlier task left here or in RUN. SIGTERM ends it after the realizations in
/// hand. Throws BadInput where this machine would not give the plan's results: another program, plugin
/// or version, or an arithmetic with other bits.
TaskEnd RunTask(const std::filesystem::path& run, int number);

/// Throws BadInput where this machine would not give the plan's results.
void RefuseOtherMachine(const Plan& plan, const std::filesystem::path& run);

}  // namespace warmjoint::inline tools
