#include "tools/cluster/wait_for_jobs.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "tools/cluster/run_status.h"
#include "tools/cluster/slurm.h"
#include "tools/cluster/submissions.h"
#include "tools/suite/interrupt.h"
#include "tools/suite/progress.h"

namespace warmjoint::inline tools {
namespace {

constexpr auto kBetweenQuestions = std::chrono::seconds(3);

bool AreOver(const std::vector<std::string>& jobs, const std::vector<QueuedTask>& queue) {
  return std::none_of(queue.begin(), queue.end(), [&](const QueuedTask& task) {
    return std::find(jobs.begin(), jobs.end(), task.job) != jobs.end();
  });
}

}  // namespace

bool WaitForJobs(const std::filesystem::path& run, const Plan& plan) {
  // how far the run is already
  const std::vector<std::string> jobs = ReadSubmissions(run).Jobs();
  int counted = StatusOf(run, plan, std::nullopt).finished;
  Progress progress(StatusOf(run, plan, std::nullopt).total, counted);
  while (!Interrupted()) {
    // a controller that does not answer is asked again
    const auto queue = AskQueue();
    if (queue && AreOver(jobs, *queue)) return true;
    std::this_thread::sleep_for(kBetweenQuestions);
    // what the tasks' states count as finished since
    const int finished = StatusOf(run, plan, std::nullopt).finished;
    progress.Add(finished - counted);
    counted = finished;
  }
  return false;
}

}  // namespace warmjoint::inline tools
