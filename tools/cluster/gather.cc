#include "tools/cluster/gather.h"

#include <stdlib.h>

#include "models/foundation/bad_input.h"
#include "models/foundation/output_failed.h"
#include "tools/board/format_board.h"
#include "tools/cluster/checkpoint.h"
#include "tools/cluster/run_layout.h"
#include "tools/cluster/run_status.h"
#include "tools/store/folders.h"

namespace warmjoint::inline tools {
namespace fs = std::filesystem;
namespace {

void RefuseMissing(const fs::path& run, const RunStatus& status) {
  // every shard that is not done is named, at work or not
  if (status.finished == status.total) return;
  std::vector<int> open = status.missing;
  for (const auto* more : {&status.running, &status.waiting, &status.failed}) {
    open.insert(open.end(), more->begin(), more->end());
  }
  std::sort(open.begin(), open.end());
  Refuse({run.string()},
         "holds {} of {} realizations; shards {} are not finished: see `warmjoint status {}`, and "
         "give --resubmit there, or `run --local-shards` again. `compare` takes what is there",
         status.finished, status.total, Ranges(open), run.string());
}

}  // namespace

MergedRun MergePlanned(const fs::path& run, const Plan& plan) {
  // all shards are there, and nobody else merges
  RefuseMissing(run, StatusOf(run, plan, std::nullopt));
  const DirectoryLock lock(run);

  // made on this machine's own disk, by the rules of a merge of equal overlaps
  const TemporaryFolder folder("merge");
  const fs::path whole = folder.path() / "run";
  const MergedRun merged = MergeRuns(ShardsOf(run), whole, &WriteTables);

  // results.sqlite last: a run that has it is whole
  for (const char* name : {"suite.yaml", "results.csv", "summary.csv", "results.sqlite"}) {
    PutFile(whole / name, run / name);
  }
  return merged;
}

}  // namespace warmjoint::inline tools
