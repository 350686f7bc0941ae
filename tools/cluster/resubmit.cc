#include "tools/cluster/resubmit.h"

#include <algorithm>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "tools/cluster/batch_script.h"
#include "tools/cluster/checkpoint.h"
#include "tools/cluster/make_plan.h"
#include "tools/cluster/run_layout.h"
#include "tools/cluster/run_status.h"
#include "tools/cluster/shard_state.h"
#include "tools/cluster/slurm.h"
#include "tools/cluster/submissions.h"
#include "tools/store/folders.h"
#include "tools/store/run_store.h"

namespace warmjoint::inline tools {
namespace fs = std::filesystem;
namespace {

/// The first realization that a shard's results lack in any variant.
int FirstOpen(const fs::path& folder, const PlannedShard& shard, int variants) {
  // a shard without results is open from its first realization on
  if (!fs::exists(folder / "results.sqlite")) return shard.first;
  const std::set<Unit> finished = RunStore::OpenToRead(folder).Finished();
  for (int realization = shard.first; realization < shard.end; ++realization) {
    for (int variant = 0; variant < variants; ++variant) {
      if (!finished.contains({variant, realization})) return realization;
    }
  }
  return shard.end;
}

/// Ends shard `number` of the plan at what it has finished and adds shards for the rest; their numbers.
std::vector<int> Split(const fs::path& run, Plan& plan, int number, int pieces, int variants) {
  // what is open is parted, and the shard ends where it begins
  PlannedShard& shard = plan.shards[static_cast<std::size_t>(number - 1)];
  const int open = FirstOpen(ShardFolder(run, number), shard, variants);
  const auto rest = PartEvenly(open, shard.end, std::min(pieces, shard.end - open));
  shard.end = open;

  // the rest goes to the end of the plan, so that no other shard changes its number
  std::vector<int> numbers;
  for (const PlannedShard& piece : rest) {
    plan.shards.push_back(piece);
    numbers.push_back(static_cast<int>(plan.shards.size()));
  }
  return numbers;
}

/// Writes down that shard `number`, which ends at what it has finished, is done.
void EndAtFinished(const fs::path& run, const Plan& plan, int number, int variants) {
  const PlannedShard& shard = plan.shards[static_cast<std::size_t>(number - 1)];
  const fs::path folder = ShardFolder(run, number);
  fs::create_directories(folder);
  ShardState state = ReadShardState(folder).value_or(ShardState());
  state.phase = Phase::done;
  state.finished = state.total = shard.size() * variants;

  // failures beyond its new end are those of the shards that follow
  const fs::path results = folder / "results.sqlite";
  state.failures.clear();
  if (fs::exists(results)) state.failures = TallyOf(results, shard).failures;
  WriteShardState(folder, state);
}

}  // namespace

std::vector<int> Resubmit(const fs::path& run, int pieces) {
  RefuseWithoutPlan(run);
  // nobody else may plan or submit meanwhile, so that the plan stays as it is read
  const DirectoryLock lock(PlanFolder(run));
  Plan plan = ReadPlan(run);
  const auto queue = AskQueue();
  if (!queue) {
    Refuse({run.string()},
           "Slurm does not answer, so that nobody knows what is at work; without Slurm go on with "
           "the same `run --local-shards N`");
  }

  // what is neither done nor at work nor in the queue is lost
  const RunStatus status = StatusOf(run, plan, InQueue(ReadSubmissions(run), *queue));
  std::vector<int> lost = status.missing;
  lost.insert(lost.end(), status.failed.begin(), status.failed.end());
  std::sort(lost.begin(), lost.end());

  // each with all its starts again, whole or in pieces
  std::vector<int> again;
  const int variants = status.total / std::max(1, status.realizations);
  for (const int number : lost) {
    Forgive(ShardFolder(run, number));
    if (pieces == 1) {
      again.push_back(number);
    } else {
      const std::vector<int> numbers = Split(run, plan, number, pieces, variants);
      again.insert(again.end(), numbers.begin(), numbers.end());
    }
  }
  // the plan has the rest of a shard before that shard is done, and both are there before a task reads them: what ends
  // this command in between leaves shards that are submitted again
  if (pieces > 1) {
    WritePlan(run, plan);
    for (const int number : lost) EndAtFinished(run, plan, number, variants);
  }
  if (!again.empty()) Submit(run, plan, again, *queue);
  return again;
}

}  // namespace warmjoint::inline tools
