#include "tools/cluster/task.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <thread>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "scenarios/parse_suite.h"
#include "tools/cluster/checkpoint.h"
#include "tools/cluster/child.h"
#include "tools/cluster/claim.h"
#include "tools/cluster/make_plan.h"
#include "tools/cluster/run_layout.h"
#include "tools/cluster/shard_state.h"
#include "tools/cluster/task_folder.h"
#include "tools/suite/describe_run.h"
#include "tools/suite/interrupt.h"

namespace warmjoint::inline tools {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kGlance = std::chrono::milliseconds(20);       // between looks at the child
constexpr auto kFarewell = std::chrono::seconds(45);          // from TERM to KILL
constexpr std::chrono::duration<double> kFirstCheckpoint{2};  // s; each next one doubles

constexpr int kBadInput = 2;  // exit status of a child that will never do

double Seconds(Clock::time_point since) {
  return std::chrono::duration<double>(Clock::now() - since).count();
}

/// The last line of what a child said before it ended.
std::string LastWords(const fs::path& file, int status) {
  // the last line that is not blank
  std::string words = fs::exists(file) ? ReadWholeFile(file) : "";
  while (!words.empty() && (words.back() == '\n' || words.back() == ' ')) words.pop_back();
  words.erase(0, words.find_last_of('\n') + 1);
  if (!words.empty()) return words;

  // a silent child is told of by its status
  return status > 128 ? fmt::format("it was ended by signal {}", status - 128)
                      : fmt::format("it ended with status {} and said nothing", status);
}

/// A shard and all that is done for it on this machine.
class Task {
 public:
  Task(fs::path run, const Plan& plan, int number)
      : run_(std::move(run)),
        plan_(plan),
        number_(number),
        shard_(plan.shards[static_cast<std::size_t>(number - 1)]),
        published_(ShardFolder(run_, number)),
        folder_(plan, number) {
    WriteWholeFile(folder_.path() / "suite.yaml", plan.suite_yaml);
  }

  TaskEnd Run() {
    state_ = TakeOver(published_);
    state_.total = shard_.size() * ParseSuite(plan_.suite_yaml, "suite.yaml").variants();
    // what was left here may be damaged, or older than what another machine went on with
    const std::optional<Tally> here = Snapshot();
    if (!here || here->finished < state_.finished) folder_.FetchStore(published_);
    // start after start, until too many in a row finish nothing
    while (state_.idle_starts <= plan_.restarts) {
      const int status = RunOnce();
      if (status == 0 && Publish()) return Finish();
      if (Interrupted()) return Leave(Phase::interrupted, "it was asked to end");
      const std::string words = LastWords(folder_.path() / "words", status);
      fmt::print(stderr, "shard {}: start {} ended with status {}: {}\n", number_, state_.starts,
                 status, words);
      if (status == kBadInput) {
        // a store that does not open, or a suite that no machine runs
        if (fetched_) return Leave(Phase::failed, words);
        folder_.FetchStore(published_);
        fetched_ = true;
      }
      Checkpoint(Phase::running, words);
    }

    // the words of the last start, which leaving writes down again
    const std::string words = state_.last_words;
    return Leave(Phase::failed, words);
  }

 private:
  std::vector<std::string> Command() const {
    std::vector<std::string> command{plan_.program.path,
                                     "run",
                                     folder_.path() / "suite.yaml",
                                     "-o",
                                     folder_.store(),
                                     "--shard",
                                     fmt::format("{}:{}", shard_.first, shard_.end),
                                     "--jobs",
                                     std::to_string(plan_.jobs)};
    // what the person agreed to goes along
    if (plan_.consent != Consent::none) command.emplace_back("--allow-commands");
    if (plan_.consent == Consent::unconfined) command.emplace_back("--unconfined");
    return command;
  }

  /// One life of the child, with checkpoints; its exit status.
  int RunOnce() {
    // an idle start until a realization is finished
    ++state_.starts;
    ++state_.idle_starts;
    start_ = Clock::now();
    finished_before_ = state_.finished;
    WriteState(Phase::running);
    // the child runs the shard, with relative names as where the plan was made
    Child child(Command(), {plan_.directory, folder_.path() / "words"});
    const std::chrono::duration<double> longest{plan_.checkpoint_seconds};
    // checkpoints soon at first, then ever less often
    auto pause = std::min(kFirstCheckpoint, longest);
    auto next = Clock::now() + std::chrono::duration_cast<Clock::duration>(pause);
    std::optional<Clock::time_point> asked;
    for (;;) {
      // its end, an interrupt that is handed on, a kill where that does not help
      if (const auto status = child.Poll()) return *status;
      if (Interrupted() && !asked) {
        child.Signal(SIGTERM);
        asked = Clock::now();
      }
      if (asked && Clock::now() - *asked > kFarewell) child.Signal(SIGKILL);
      // what is finished goes into the run
      if (Clock::now() > next) {
        Checkpoint(Phase::running, state_.last_words);
        pause = std::min(2 * pause, longest);
        next = Clock::now() + std::chrono::duration_cast<Clock::duration>(pause);
      }
      std::this_thread::sleep_for(kGlance);
    }
  }

  TaskEnd Finish() {
    state_.last_words = "";
    WriteState(Phase::done);
    folder_.Remove();
    return TaskEnd::done;
  }

  TaskEnd Leave(Phase phase, const std::string& words) {
    Checkpoint(phase, words);
    if (phase == Phase::failed) folder_.Remove();
    return phase == Phase::failed ? TaskEnd::failed : TaskEnd::interrupted;
  }

  /// Takes copies of the store, which the child may be writing to; what they hold. Nothing where there is no store, or
  /// a damaged one.
  std::optional<Tally> Snapshot() const {
    if (!folder_.HasStore()) return std::nullopt;
    const fs::path results = folder_.path() / "results.snapshot";
    try {
      TakeSnapshot(folder_.store() / "timings.sqlite", folder_.path() / "timings.snapshot");
      TakeSnapshot(folder_.store() / "results.sqlite", results);
      return TallyOf(results, shard_);
    } catch (const BadInput& damage) {
      fmt::print(stderr, "shard {}: {}\n", number_, damage.what());
      return std::nullopt;
    }
  }

  /// Copies what is finished into the run, timings first. Whether there was a sound store to copy.
  bool Publish() {
    const std::optional<Tally> tally = Snapshot();
    if (!tally) return false;
    const bool more = tally->finished > state_.finished;
    if (more || !fs::exists(published_ / "results.sqlite")) {
      PutFile(folder_.path() / "timings.snapshot", published_ / "timings.sqlite");
      PutFile(folder_.path() / "results.snapshot", published_ / "results.sqlite");
    }
    // how far the shard is
    if (more) state_.idle_starts = 0;
    state_.finished = tally->finished;
    state_.failures = tally->failures;
    const double seconds = Seconds(start_);
    state_.rate = seconds > 0 ? (state_.finished - finished_before_) / seconds : 0;
    return true;
  }

  /// Publishes what is finished and writes down how far the shard is.
  void Checkpoint(Phase phase, const std::string& words) {
    state_.last_words = words;
    Publish();
    WriteState(phase);
  }

  void WriteState(Phase phase) {
    state_.phase = phase;
    state_.updated = Now();
    WriteShardState(published_, state_);
  }

  fs::path run_;
  const Plan& plan_;
  int number_;
  PlannedShard shard_;
  fs::path published_;  // the shard's folder in the run
  TaskFolder folder_;
  ShardState state_;
  bool fetched_ = false;  // the run's copy, in place of what was left here
  Clock::time_point start_ = Clock::now();
  int finished_before_ = 0;
};

void RefuseOther(const char* what, const PinnedFile& planned, const PinnedFile& here,
                 const Place& place) {
  if (planned.sha256 == here.sha256) return;
  Refuse(place,
         "was made with another {} ({}) than this machine's ({}); run the tasks with the program "
         "that made the plan, or plan the run anew",
         what, planned.path.empty() ? "none" : planned.path,
         here.path.empty() ? "none" : here.path);
}

}  // namespace

void RefuseOtherMachine(const Plan& plan, const fs::path& run) {
  const Place place{PlanFile(run).string()};
  RefuseOther("program", plan.program, ThisProgram(), place);
  RefuseOther("plugin", plan.plugin, ThisPlugin(), place);
  const RunDescription here = Describe(ParseSuite(plan.suite_yaml, place.file));
  for (const auto& [name, value] : here.versions) {
    const auto planned = std::find_if(plan.versions.begin(), plan.versions.end(),
                                      [&](const auto& one) { return one.first == name; });
    if (planned != plan.versions.end() && planned->second == value) continue;
    Refuse(place, "was made where {} is {}, which is {} on {}: its results would have other bits",
           name, planned == plan.versions.end() ? "unknown" : planned->second, value, HostName());
  }
}

TaskEnd RunTask(const fs::path& run, int number) {
  const Plan plan = ReadPlan(run);
  const auto shards = static_cast<int>(plan.shards.size());
  if (number < 1 || number > shards) {
    Refuse({PlanFile(run).string()}, "has no shard {}; it has 1 to {}", number, shards);
  }
  const fs::path folder = ShardFolder(run, number);
  fs::create_directories(folder);
  if (plan.shards[static_cast<std::size_t>(number - 1)].size() == 0) {
    // of more shards than realizations
    ShardState state = TakeOver(folder);
    state.phase = Phase::done;
    state.updated = Now();
    WriteShardState(folder, state);
    return TaskEnd::done;
  }
  switch (LookAt(folder, Patience(plan.checkpoint_seconds))) {
    case Claim::done:
      return TaskEnd::done;
    case Claim::failed:
      return TaskEnd::failed;
    case Claim::taken:
      return TaskEnd::elsewhere;
    case Claim::interrupted:
      return TaskEnd::interrupted;
    case Claim::free:
      break;
  }
  try {
    RefuseOtherMachine(plan, run);
  } catch (const BadInput& refusal) {
    NoteRefusal(folder, refusal.what());
    throw;
  }
  return Task(run, plan, number).Run();
}

}  // namespace warmjoint::inline tools
