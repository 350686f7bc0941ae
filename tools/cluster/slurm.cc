#include "tools/cluster/slurm.h"

#include <fmt/format.h>
#include <stdio.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/parse_number.h"
#include "tools/terminal/shell_words.h"

namespace warmjoint {
namespace {

constexpr int kDefaultArraySize = 1001;  // Slurm's own

/// Keys that the script sets itself.
constexpr std::array<const char*, 6> kOwnKeys{"array",   "output",   "open-mode",
                                              "requeue", "job-name", "dependency"};

constexpr const char* kScript = R"sh(#!/bin/bash
# The shards of {run}, which `warmjoint run` wrote. By hand:
#   sbatch --array=1-{shards} {script}
#   sbatch --dependency=afterany:JOB {script}     merges
# A shard begins anew whenever it is started, and is skipped once its results are in the run.
{directives}
if [ -z "$SLURM_ARRAY_TASK_ID" ]; then
  {merge}
  exit $?
fi

cd {directory} || exit 2
{command}
status=$?

# Slurm starts a shard anew whose node is lost (--requeue). One whose program alone was killed is asked for here, five times
# at most; a controller that is away is asked again
if [ $status -eq 137 ] && [ "${{SLURM_RESTART_COUNT:-0}}" -lt 5 ]; then
  for pause in 1 2 4 8 16 32; do
    scontrol requeue "${{SLURM_ARRAY_JOB_ID}}_$SLURM_ARRAY_TASK_ID" && sleep 60
    sleep $pause
  done
fi
exit $status
)sh";

/// What a program answered.
struct CommandAnswer {
  int status = 127;  // as a shell has it; 127: there is no such program
  std::string words;
};

CommandAnswer Ask(const std::vector<std::string>& command, const char* errors) {
  CommandAnswer answer;
  FILE* pipe = popen((JoinCommand(command) + errors).c_str(), "re");
  if (!pipe) return answer;
  std::array<char, 4096> block;
  while (const std::size_t n = fread(block.data(), 1, block.size(), pipe)) {
    answer.words.append(block.data(), n);
  }
  const int status = pclose(pipe);
  answer.status = WIFEXITED(status) ? WEXITSTATUS(status) : 127;
  return answer;
}

/// Submits the script; its job number.
std::string Sbatch(const Plan& plan, const std::vector<std::string>& options) {
  std::vector<std::string> command{"sbatch", "--parsable"};
  command.insert(command.end(), options.begin(), options.end());
  command.push_back(plan.script());
  const CommandAnswer answer = Ask(command, " 2>&1");
  if (answer.status != 0) {
    Refuse({"sbatch"},
           "{}; RUN/slurm/array.sbatch may be edited, then `warmjoint status {} "
           "--resubmit` submits what is missing",
           Excerpt(answer.words, kLongestComplaint), plan.run.string());
  }
  // the last line is JOB or JOB;CLUSTER
  const std::string words = answer.words.substr(0, answer.words.find_last_not_of('\n') + 1);
  const std::string line = words.substr(words.find_last_of('\n') + 1);
  const std::string job = line.substr(0, line.find(';'));
  if (!ParseInteger(job)) {
    Refuse({"sbatch"}, "answered '{}', which is not a job number", Excerpt(answer.words));
  }
  return job;
}

/// A line for sbatch.
std::string Directive(const std::string& key, const std::string& value) {
  return fmt::format("#SBATCH --{}=\"{}\"\n", key, value);
}

/// What jobs of the run are called, so that the queue tells them.
std::string JobName(const Plan& plan) { return "warmjoint:" + plan.run.string(); }

}  // namespace

void CheckSbatch(const std::vector<std::string>& entries) {
  for (const std::string& entry : entries) {
    // a key of lower-case letters and hyphens, and nothing that breaks out of a quoted line
    const std::size_t equals = entry.find('=');
    const std::string key = entry.substr(0, equals);
    const bool fits = equals != std::string::npos && !key.empty() &&
                      key.find_first_not_of("abcdefghijklmnopqrstuvwxyz-") == std::string::npos &&
                      std::none_of(entry.begin(), entry.end(),
                                   [](unsigned char c) { return c < 32 || c == '"' || c == '\\'; });
    if (!fits) {
      Refuse({"--sbatch"}, "is '{}'; give key=value, for example partition=long", Excerpt(entry));
    }
    if (std::find(kOwnKeys.begin(), kOwnKeys.end(), key) == kOwnKeys.end()) continue;
    Refuse({"--sbatch"}, "is '{}'; the script sets {} itself: edit array.sbatch after --dry-run",
           Excerpt(entry), key);
  }
}

void RefuseLargeArray(int shards) {
  // the line "MaxArraySize = 1001" bounds the indices, which begin at 1
  int size = kDefaultArraySize;
  std::istringstream lines(Ask({"scontrol", "show", "config"}, " 2>/dev/null").words);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string key, equals, value;
    words >> key >> equals >> value;
    const auto number = ParseInteger(value);
    if (key == "MaxArraySize" && number && *number > 1) size = static_cast<int>(*number);
  }
  if (shards < size) return;
  Refuse({"--shards"},
         "is {}; an array of this cluster has at most {} (its MaxArraySize is {}): give "
         "--shards {}, and --jobs for more threads each",
         shards, size - 1, size, size - 1);
}

std::string ArrayScript(const Plan& plan, const std::vector<std::string>& sbatch, int jobs,
                        const std::vector<std::string>& more) {
  // percent signs of a path are no patterns of sbatch
  const std::string log = Replaced((plan.folder() / "log").string(), "%", "%%");
  std::string directives = Directive("job-name", JobName(plan));
  directives += Directive("cpus-per-task", std::to_string(jobs));
  directives += Directive("output", log + "/%A_%a.log") + Directive("open-mode", "append");
  directives += "#SBATCH --requeue\n";
  for (const std::string& entry : sbatch) {
    const std::size_t equals = entry.find('=');
    directives += Directive(entry.substr(0, equals), entry.substr(equals + 1));
  }
  // the number is the shell's to fill in
  std::vector<std::string> command = ShardCommand(plan, "NUMBER", more);
  const std::string program = command.front();
  return fmt::format(
      kScript, fmt::arg("run", plan.run.string()), fmt::arg("shards", plan.shards),
      fmt::arg("script", JoinCommand({plan.script()})), fmt::arg("directives", directives),
      fmt::arg("merge", JoinCommand({program, "merge", plan.run})),
      fmt::arg("directory", JoinCommand({std::filesystem::current_path()})),
      fmt::arg("command", Replaced(JoinCommand(command), fmt::format("NUMBER/{}", plan.shards),
                                   fmt::format("$SLURM_ARRAY_TASK_ID/{}", plan.shards))));
}

std::optional<QueuedShards> AskQueue(const Plan& plan) {
  // one line for each task: its array job, its index, its state and its name
  const CommandAnswer answer =
      Ask({"squeue", "-h", "-r", "--me", "-o", "%F %K %T %j"}, " 2>/dev/null");
  if (answer.status != 0) return std::nullopt;
  QueuedShards queued;
  std::istringstream lines(answer.words);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string job, index, state, name;
    words >> job >> index >> state >> std::ws;
    std::getline(words, name);
    // a job that merges has no index
    const auto number = ParseInteger(index);
    if (name != JobName(plan) || !number) continue;
    // all that has started counts as running, COMPLETING too: such a task may still be writing
    (state == "PENDING" ? queued.waiting : queued.running).push_back(static_cast<int>(*number));
    const bool known = std::find(queued.jobs.begin(), queued.jobs.end(), job) != queued.jobs.end();
    if (!known) queued.jobs.push_back(job);
  }
  std::sort(queued.running.begin(), queued.running.end());
  std::sort(queued.waiting.begin(), queued.waiting.end());
  return queued;
}

std::vector<int> SubmitOpen(const Plan& plan) {
  auto queued = AskQueue(plan);
  if (!queued) {
    Refuse({plan.run.string()},
           "Slurm does not answer (squeue); without Slurm go on with `run --local-shards N`");
  }
  std::vector<int> open = plan.Open();
  std::erase_if(open, [&](int number) {
    return std::ranges::binary_search(queued->running, number) ||
           std::ranges::binary_search(queued->waiting, number);
  });
  if (open.empty()) return open;

  // the shards as one array, and a job that merges once these and all others have ended
  queued->jobs.push_back(Sbatch(plan, {"--array=" + Ranges(open, ",")}));
  Sbatch(plan, {fmt::format("--dependency=afterany:{}", fmt::join(queued->jobs, ":")),
                "--output=" + (plan.folder() / "log").string() + "/merge_%j.log"});
  return open;
}

}  // namespace warmjoint
