#include "tools/cluster/local_shards.h"

#include <signal.h>

#include <chrono>
#include <deque>
#include <map>
#include <thread>

#include "tools/cluster/child.h"
#include "tools/cluster/run_layout.h"
#include "tools/cluster/run_status.h"
#include "tools/suite/interrupt.h"
#include "tools/suite/progress.h"

namespace warmjoint::inline tools {
namespace fs = std::filesystem;
namespace {

constexpr auto kGlance = std::chrono::milliseconds(20);  // between looks at the tasks
constexpr auto kNews = std::chrono::seconds(1);          // between looks at their states
constexpr int kSignalled = 128;  // exit status from which on a signal ended the task

/// The realizations that the shards' states count, shown where stderr is a terminal.
class Watch {
 public:
  Watch(fs::path run, const Plan& plan)
      : run_(std::move(run)), plan_(plan), counted_(Count()), progress_(total_, counted_) {}

  void Look() {
    // states are files: once a second is often enough
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return;
    next_ = now + kNews;
    const int finished = Count();
    progress_.Add(finished - counted_);
    counted_ = finished;
  }

 private:
  int Count() {
    const RunStatus status = StatusOf(run_, plan_, std::nullopt);
    total_ = status.total;
    return status.finished;
  }

  fs::path run_;
  const Plan& plan_;
  int total_ = 0;
  int counted_;
  Progress progress_;
  std::chrono::steady_clock::time_point next_{};
};

}  // namespace

bool RunLocally(const fs::path& run, const Plan& plan, const std::vector<int>& shards,
                int at_once) {
  std::deque<int> open(shards.begin(), shards.end());
  std::map<int, Child> running;
  Watch watch(run, plan);
  bool asked = false;
  // until nothing runs, and nothing is to be started any more
  while (!running.empty() || (!open.empty() && !Interrupted())) {
    // an interrupt is handed on once; the tasks end by themselves
    if (Interrupted() && !asked) {
      for (const auto& entry : running) entry.second.Signal(SIGTERM);
      asked = true;
    }

    // as many tasks at once as were asked for
    while (!asked && !open.empty() && running.size() < static_cast<std::size_t>(at_once)) {
      const int number = open.front();
      open.pop_front();
      const std::vector<std::string> command{plan.program.path, "task", run,
                                             std::to_string(number)};
      running.emplace(number, Child(command, {}));
    }

    std::this_thread::sleep_for(kGlance);
    watch.Look();

    // what has ended makes room; a task that was killed is started again
    for (auto entry = running.begin(); entry != running.end();) {
      const auto status = entry->second.Poll();
      // the shard's own count of starts bounds this
      if (status && *status > kSignalled && !asked) open.push_back(entry->first);
      entry = status ? running.erase(entry) : std::next(entry);
    }
  }
  return open.empty() && !asked;
}

}  // namespace warmjoint::inline tools
