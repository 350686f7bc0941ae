#include "tools/cluster/run_status.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "scenarios/parse_suite.h"
#include "tools/cluster/run_layout.h"
#include "tools/cluster/shard_state.h"
#include "tools/terminal/progress_line.h"

namespace warmjoint::inline tools {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMostWords = 5;  // shards whose last words the text shows

bool Holds(const std::vector<int>& ascending, int number) {
  return std::binary_search(ascending.begin(), ascending.end(), number);
}

/// Whether a task is at work on the shard, as far as can be known.
bool IsRunning(const ShardState& state, int number, const Plan& plan,
               const std::optional<QueuedShards>& queue) {
  if (state.phase != Phase::running) return false;
  // the queue knows of a kill before the silence tells; a task outside of it has its word alone
  const bool submitted =
      state.owner.find('_') != std::string::npos && state.owner.find(':') == std::string::npos;
  if (queue && submitted) return Holds(queue->running, number);
  return Now() - state.updated <= Patience(plan.checkpoint_seconds);
}

void Add(RunStatus& status, int number, const Plan& plan, const std::optional<ShardState>& state,
         const std::optional<QueuedShards>& queue) {
  // what is finished counts, whoever finished it
  if (state) {
    status.finished += state->finished;
    for (const auto& [name, count] : state->failures) status.failures[name] += count;
  }

  // done and at work by the shard's own word, then what the queue says, then what is left
  if (state && state->phase == Phase::done) {
    status.done.push_back(number);
  } else if (state && IsRunning(*state, number, plan, queue)) {
    status.running.push_back(number);
    status.rate += state->rate;
  } else if (queue && (Holds(queue->running, number) || Holds(queue->waiting, number))) {
    // started this moment, or about to be
    (Holds(queue->running, number) ? status.running : status.waiting).push_back(number);
  } else if (state && state->phase == Phase::failed) {
    status.failed.push_back(number);
    status.last_words.push_back({number, state->last_words});
  } else {
    status.missing.push_back(number);
    if (state && !state->last_words.empty()) {
      status.last_words.push_back({number, state->last_words});
    }
  }
}

}  // namespace

RunStatus StatusOf(const fs::path& run, const Plan& plan,
                   const std::optional<QueuedShards>& queue) {
  // of the suite as a whole
  const Suite suite = ParseSuite(plan.suite_yaml, PlanFile(run).string());
  RunStatus status;
  status.suite = suite.name;
  status.realizations = suite.realizations;
  status.total = suite.realizations * suite.variants();
  status.merged = fs::exists(run / "results.sqlite");
  // each shard by its state file and the queue
  for (std::size_t i = 0; i < plan.shards.size(); ++i) {
    const int number = static_cast<int>(i) + 1;
    Add(status, number, plan, ReadShardState(ShardFolder(run, number)), queue);
  }
  // at the present rate of all tasks together
  if (status.rate > 0) status.seconds_left = (status.total - status.finished) / status.rate;
  return status;
}

std::string StatusText(const fs::path& run, const RunStatus& status) {
  // how far the run is, and how long it takes
  std::string text =
      fmt::format("{}: {} of {} realizations", status.suite, status.finished, status.total);
  if (status.rate > 0) text += fmt::format(", {:.3g}/s", status.rate);
  if (status.seconds_left) text += fmt::format(", {} left", DurationInWords(*status.seconds_left));
  text += status.merged ? ", merged\n" : "\n";
  // the shards by what they do
  text += fmt::format("shards: {} done, {} running, {} waiting, {} missing, {} failed\n",
                      status.done.size(), status.running.size(), status.waiting.size(),
                      status.missing.size(), status.failed.size());
  if (!status.missing.empty()) text += "missing: " + Ranges(status.missing) + "\n";
  if (!status.failed.empty()) text += "failed: " + Ranges(status.failed) + "\n";
  // why some did not end well, the first few
  for (std::size_t i = 0; i < std::min(kMostWords, status.last_words.size()); ++i) {
    const ShardWords& one = status.last_words[i];
    text += fmt::format("shard {}: {}\n", one.shard, one.words);
  }
  // failed identifiers are results and do not stop a merge
  if (!status.failures.empty()) {
    std::vector<std::string> counts;
    for (const auto& [name, count] : status.failures) {
      counts.push_back(fmt::format("{} {}", name, count));
    }
    text += fmt::format("failures of identifiers: {}\n", fmt::join(counts, ", "));
  }
  // nothing is left but to merge
  if (!status.merged && status.done.size() > 0 && status.finished == status.total) {
    text += fmt::format("all is there: warmjoint merge {}\n", run.string());
  }
  return text;
}

nlohmann::json StatusJson(const RunStatus& status) {
  // the same as the text, without its bound on last words
  nlohmann::json words = nlohmann::json::array();
  for (const ShardWords& one : status.last_words) {
    words.push_back({{"shard", one.shard}, {"last_words", one.words}});
  }
  return {{"suite", status.suite},
          {"realizations", {{"finished", status.finished}, {"total", status.total}}},
          {"merged", status.merged},
          {"shards",
           {{"done", status.done},
            {"running", status.running},
            {"waiting", status.waiting},
            {"missing", status.missing},
            {"failed", status.failed}}},
          {"failures", status.failures},
          {"rate", status.rate},
          {"seconds_left", status.seconds_left ? nlohmann::json(*status.seconds_left) : nullptr},
          {"last_words", words}};
}

}  // namespace warmjoint::inline tools
