#include "tools/suite/engine.h"

#include <ceres/version.h>
#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <csignal>
#include <exception>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/parse_number.h"
#include "tools/suite/run_realization.h"
#include "tools/terminal/progress_line.h"

namespace warmjoint {
namespace {

std::atomic<bool> interrupted = false;  // lock-free, so that a handler may set it

extern "C" void OnInterrupt(int signal) {
  interrupted = true;
  std::signal(signal, SIG_DFL);
}

/// Longest time that finished realizations wait for the store, and so what a kill can cost.
constexpr std::chrono::milliseconds kBatchTime{200};

/// Units of the shard, each realization in every variant before the next, so that an early look at
/// the leaderboard compares the variants.
std::vector<RunUnit> UnitsOf(const Suite& suite, const Shard& shard) {
  std::vector<RunUnit> units;
  const int end = shard.End(suite.realizations);
  for (int realization = shard.First(suite.realizations); realization < end; ++realization) {
    for (int variant = 0; variant < suite.variants(); ++variant) {
      units.push_back({variant, realization});
    }
  }
  return units;
}

/// Finished realizations on their way from the workers to the one writer: workers put, the writer takes. A worker that dies
/// hands its exception over.
class FinishedQueue {
 public:
  explicit FinishedQueue(int workers) : workers_(workers) {}

  void Put(RealizationResult done) {
    const std::lock_guard lock(mutex_);
    following_.Add(done.realization.unit, done.following);
    finished_.push_back(std::move(done.realization));
  }

  /// A worker has ended; error: what ended it, or nullptr.
  void Leave(std::exception_ptr error) {
    const std::lock_guard lock(mutex_);
    --workers_;
    if (error) error_ = error;
    changed_.notify_one();
  }

  /// All that finished within `longest`, or at once when the last worker leaves.
  std::vector<Realization> Take(std::chrono::milliseconds longest) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, longest, [this] { return workers_ == 0; });
    return std::exchange(finished_, {});
  }

  /// Whether all workers have left and everything was taken. Throws what ended a worker.
  bool Done() {
    const std::lock_guard lock(mutex_);
    if (workers_ == 0 && error_) std::rethrow_exception(error_);
    return workers_ == 0 && finished_.empty();
  }

  /// Of all that was put. For when it is done.
  const FollowingTally& following() const { return following_; }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Realization> finished_;
  FollowingTally following_;
  std::exception_ptr error_;
  int workers_;
};

/// Failures that the store holds, by their status.
std::map<std::string, int> FailuresIn(const RunStore& store) {
  std::map<std::string, int> failures;
  for (const StatusCount& count : store.CountStatuses()) {
    if (count.status != "ok") failures[count.status] += static_cast<int>(count.results);
  }
  return failures;
}

/// What the workers share.
struct Work {
  const Suite& suite;
  const Contestants& contestants;
  const std::vector<RunUnit>& units;
  const std::filesystem::path recordings;  // where to keep them; empty: nowhere
  std::atomic<size_t> next{0};
  std::atomic<bool> stop{false};
  FinishedQueue queue;

  bool Open() const { return !stop && !Interrupted(); }
};

void RunUnits(Work& work) {
  std::exception_ptr error;
  try {
    // plants are made once for each variant and thread
    std::vector<Bench> benches(static_cast<size_t>(work.suite.variants()));
    // the next unit that no thread has taken
    while (work.Open()) {
      const size_t i = work.next++;
      if (i >= work.units.size()) break;
      const RunUnit unit = work.units[i];
      Bench& bench = benches[static_cast<size_t>(unit.variant)];
      if (!bench.plant) bench = MakeBench(VariantScenario(work.suite, unit.variant));
      // simulated and identified; the results wait for the thread that stores
      work.queue.Put(RunRealization(bench, work.contestants, unit, work.recordings));
    }
  } catch (...) {
    // an error in one thread ends the work of all
    error = std::current_exception();
    work.stop = true;
  }
  work.queue.Leave(error);
}

void Report(Progress& progress, const std::vector<Realization>& batch) {
  for (const Realization& realization : batch) {
    for (const Result& result : realization.results) {
      if (result.status != "ok") progress.AddFailure(result.status);
    }
  }
  progress.Add(static_cast<int>(batch.size()));
}

/// Writes batch after batch until the workers are done; stops them when the store or `tell` fails.
int Store(Work& work, RunStore& store,
          const std::function<void(const std::vector<Realization>&)>& tell) {
  int stored = 0;
  try {
    // results are stored in batches as they come
    while (!work.queue.Done()) {
      const std::vector<Realization> batch = work.queue.Take(kBatchTime);
      if (!batch.empty()) store.Write(batch);
      stored += static_cast<int>(batch.size());
      tell(batch);
    }
  } catch (...) {
    // without a store there is no use in working on
    work.stop = true;
    throw;
  }
  return stored;
}

}  // namespace

RunDescription Describe(const Suite& suite) {
  RunDescription description;
  description.suite_yaml = SuiteToYaml(suite);
  // all that the numbers may depend on
  description.versions = {
      {"ceres", CERES_VERSION_STRING},
      {"eigen",
       fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"mujoco", mj_versionString()},
      {"warmjoint", Version()},
  };
  return description;
}

void CatchInterrupts() {
  interrupted = false;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, OnInterrupt);
}

bool Interrupted() { return interrupted; }

RunOutcome RunSuite(const Suite& suite, const Contestants& contestants, const RunOptions& options,
                    RunStore& store) {
  // units of this shard that are not stored yet
  std::vector<RunUnit> units = UnitsOf(suite, options.shard);
  const auto total = static_cast<int>(units.size());
  const std::set<RunUnit> stored = store.Finished();
  std::erase_if(units, [&](const RunUnit& unit) { return stored.contains(unit); });
  const int already = total - static_cast<int>(units.size());

  // no more threads than units
  const int workers = std::clamp(options.jobs, 1, std::max(1, static_cast<int>(units.size())));
  const std::filesystem::path recordings =
      options.keep_recordings ? store.directory() / "recordings" : "";
  Work work{suite, contestants, units, recordings, 0, false, FinishedQueue(workers)};
  Progress progress(total, already, FailuresIn(store));
  // who watches is told numbers, everybody else reads lines
  int told = already;
  const auto tell = [&](const std::vector<Realization>& batch) {
    if (!options.watch) return Report(progress, batch);
    if (!batch.empty()) options.watch(told += static_cast<int>(batch.size()), total);
  };

  // declared last, so that the threads are joined before anything they use goes
  std::vector<std::jthread> threads;
  for (int i = 0; i < workers; ++i) threads.emplace_back(RunUnits, std::ref(work));
  const int finished = already + Store(work, store, tell);
  return {finished, total, Interrupted() && finished < total, work.queue.following()};
}

void FollowingTally::Add(RunUnit unit, const Following& following) {
  ++realizations_;
  if (following.Follows()) return;
  // the same one whatever order threads finish in
  const bool worse =
      following.share < worst_.share || (following.share == worst_.share && unit < worst_unit_);
  if (astray_++ > 0 && !worse) return;
  worst_ = following;
  worst_unit_ = unit;
}

std::string FollowingTally::Words(const Suite& suite) const {
  if (astray_ == 0) return "";
  const auto variant = static_cast<std::size_t>(worst_unit_.variant);
  const std::string rung =
      suite.ladder ? " of " + Excerpt(suite.ladder->variants[variant].name) : "";
  return fmt::format(
      "in {} of {} simulated realizations the joint did not follow its motion. In "
      "realization {}{} {}",
      astray_, realizations_, worst_unit_.realization, rung, worst_.Words());
}

Shard ReadShard(const std::string& text) {
  // whole numbers on both sides of the stroke
  if (const size_t stroke = text.find('/'); stroke != std::string::npos) {
    const auto index = ParseInteger(text.substr(0, stroke));
    const auto count = ParseInteger(text.substr(stroke + 1));
    if (index && count && 1 <= *index && *index <= *count && *count <= kMostShards) {
      return {static_cast<int>(*index), static_cast<int>(*count)};
    }
  }
  Refuse({"--shard"}, "is '{}'; give i/n with 1 <= i <= n, for example 1/4", Excerpt(text));
}

}  // namespace warmjoint
