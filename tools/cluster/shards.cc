#include "tools/cluster/shards.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <deque>
#include <fstream>
#include <map>
#include <system_error>
#include <thread>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "tools/board/format_board.h"
#include "tools/store/folders.h"
#include "tools/suite/engine.h"
#include "tools/terminal/progress_line.h"
#include "tools/terminal/shell_words.h"

namespace warmjoint {
namespace fs = std::filesystem;
namespace {

constexpr auto kPollInterval = std::chrono::milliseconds(20);
constexpr int kMostStarts = 3;   // of a shard whose process is killed
constexpr int kNoProgram = 127;  // exit status, as shells have it
constexpr int kSignalled = 128;  // added to the signal that ended a process

/// Copies a file so that the target is the old or the new one as a whole, on disk before it has its name.
void CopyWhole(const fs::path& file, const fs::path& target) {
  std::ifstream from(file, std::ios::binary);
  if (!from) Refuse({file.string()}, "cannot be read");
  AtomicFile to(target);
  std::vector<char> block(1 << 20);
  while (from.read(block.data(), static_cast<std::streamsize>(block.size())), from.gcount() > 0) {
    to.Write({block.data(), static_cast<std::size_t>(from.gcount())});
  }
  to.Commit();
}

/// Units of the run that `merged` lacks.
std::set<RunUnit> MissingUnits(const RunStore& merged) {
  const std::set<RunUnit> finished = merged.Finished();
  std::set<RunUnit> missing;
  for (int variant = 0; variant < merged.suite().variants(); ++variant) {
    for (int realization = 0; realization < merged.suite().realizations; ++realization) {
      const RunUnit unit{variant, realization};
      if (!finished.contains(unit)) missing.insert(missing.end(), unit);
    }
  }
  return missing;
}

/// Starts a shard's process, which dies with this one and says on stderr what goes wrong.
pid_t Start(std::vector<std::string> command) {
  // all that needs memory comes before the fork
  const std::vector<char*> argv = ExecWords(command);
  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid < 0) throw std::system_error(errno, std::generic_category(), "no process");
  if (pid > 0) return pid;
  prctl(PR_SET_PDEATHSIG, SIGKILL, 0, 0, 0);
  if (getppid() != parent) _exit(kNoProgram);
  const int nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDOUT_FILENO);
  execv(argv[0], argv.data());
  _exit(kNoProgram);
}

}  // namespace

void Publish(const Plan& plan, int number, const fs::path& results) {
  const fs::path target = plan.Results(number);
  // what a killed task was copying goes
  fs::remove_all(target.parent_path());
  fs::create_directories(target.parent_path());
  CopyWhole(results, target);
}

LocalEnd RunLocally(const Plan& plan, int at_once, const std::vector<std::string>& more) {
  const std::vector<int> missing = plan.Open();
  std::deque<int> open(missing.begin(), missing.end());
  std::map<pid_t, int> running;  // number of the shard
  std::map<int, int> starts;
  LocalEnd end;
  int finished = plan.suite.realizations * plan.suite.variants();
  for (const int number : missing) finished -= plan.Units(number);
  Progress progress(plan.suite.realizations * plan.suite.variants(), finished);

  // until nothing runs, and nothing is to be started any more
  while (!running.empty() || (!open.empty() && !end.interrupted && end.failed == 0)) {
    // an interrupt is handed on once; a shard that failed stops what has not started
    if (Interrupted() && !end.interrupted) {
      end.interrupted = true;
      for (const auto& [pid, number] : running) kill(pid, SIGTERM);
    }
    const bool go_on = !end.interrupted && end.failed == 0;
    while (go_on && !open.empty() && running.size() < static_cast<std::size_t>(at_once)) {
      const int number = open.front();
      open.pop_front();
      ++starts[number];
      running.emplace(Start(ShardCommand(plan, std::to_string(number), more)), number);
    }

    // one process that has ended makes room
    int status = 0;
    const pid_t pid = waitpid(-1, &status, WNOHANG);
    const auto ended = running.find(pid);
    if (ended == running.end()) {
      progress.Add(0);
      std::this_thread::sleep_for(kPollInterval);
      continue;
    }
    const int number = ended->second;
    running.erase(ended);
    const bool killed = WIFSIGNALED(status);
    const int code = killed ? kSignalled + WTERMSIG(status) : WEXITSTATUS(status);
    if (code == 0) {
      progress.Add(plan.Units(number));
    } else if (killed && starts[number] < kMostStarts) {
      open.push_back(number);
    } else if (!end.interrupted) {
      end.failed = number;
      end.status = code;
    }
  }
  return end;
}

MergedRun MergeRuns(const std::vector<fs::path>& shards, const fs::path& directory) {
  if (shards.empty()) Refuse({directory.string()}, "has no shards to merge; give at least one");
  // all shards must be of one run, before anything is written
  const RunDescription description = RunStore::OpenToRead(shards.front()).description();
  for (const auto& path : shards) {
    RefuseDifferentRun(description, RunStore::OpenToRead(path).description(), {path.string()});
  }

  // the merged run is not seen before it is whole
  AtomicDirectory whole(directory, {});
  MergedRun outcome;
  {
    // rows of all shards, their tables, and what is still missing
    RunStore merged = RunStore::CreateOrResume(whole.temporary(), description);
    merged.Gather(shards);
    WriteTables(merged);
    outcome.missing = MissingUnits(merged);
    outcome.units = static_cast<std::size_t>(merged.suite().realizations) *
                    static_cast<std::size_t>(merged.suite().variants());
  }
  whole.Commit();
  return outcome;
}

void MergePlanned(const Plan& plan) {
  // all shards are there, and nobody else merges
  const std::vector<int> missing = plan.Open();
  if (!missing.empty()) {
    Refuse({plan.run.string()},
           "shards {} of {} have no results yet: see `warmjoint status {}`, and give --resubmit "
           "there, or `run --local-shards N` again. `compare` takes what is there",
           Ranges(missing), plan.shards, plan.run.string());
  }
  const DirectoryLock lock(plan.run);
  const TemporaryFolder folder("merge");
  const fs::path whole = folder.path() / "run";
  MergeRuns(ShardsOf(plan.run), whole);

  // results.sqlite last: a run that has it is whole
  for (const char* name : {"suite.yaml", "results.csv", "summary.csv", "results.sqlite"}) {
    CopyWhole(whole / name, plan.run / name);
  }
}

}  // namespace warmjoint
