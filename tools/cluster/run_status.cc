#include "tools/cluster/run_status.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace warmjoint {

RunStatus StatusOf(const Plan& plan, const std::optional<QueuedShards>& queue) {
  RunStatus status;
  status.suite = plan.suite.name;
  status.merged = plan.IsMerged();
  for (int number = 1; number <= plan.shards; ++number) {
    status.total += plan.Units(number);
    // results first, then what the queue says, then what is left
    if (plan.IsDone(number)) {
      status.done.push_back(number);
      status.finished += plan.Units(number);
    } else if (queue && std::ranges::binary_search(queue->running, number)) {
      status.running.push_back(number);
    } else if (queue && std::ranges::binary_search(queue->waiting, number)) {
      status.waiting.push_back(number);
    } else {
      status.missing.push_back(number);
    }
  }
  return status;
}

std::string StatusText(const Plan& plan, const RunStatus& status) {
  std::string text = fmt::format("{}: {} of {} realizations{}\n", status.suite, status.finished,
                                 status.total, status.merged ? ", merged" : "");
  text += fmt::format("shards: {} done, {} running, {} waiting, {} missing\n", status.done.size(),
                      status.running.size(), status.waiting.size(), status.missing.size());
  // what a person has to do
  const std::string run = plan.run.string();
  if (!status.missing.empty()) {
    text += fmt::format(
        "missing: {}\nthey were not started, or ended without results: see {}/log. `warmjoint "
        "status {} --resubmit` submits them; without Slurm `run --local-shards N` goes on\n",
        Ranges(status.missing), plan.folder().string(), run);
  } else if (!status.merged && status.finished == status.total) {
    text += fmt::format("all is there: warmjoint merge {}\n", run);
  }
  return text;
}

nlohmann::json StatusJson(const RunStatus& status) {
  return {{"suite", status.suite},
          {"realizations", {{"finished", status.finished}, {"total", status.total}}},
          {"merged", status.merged},
          {"shards",
           {{"done", status.done},
            {"running", status.running},
            {"waiting", status.waiting},
            {"missing", status.missing}}}};
}

}  // namespace warmjoint
