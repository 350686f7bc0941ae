#include "tools/cluster/batch_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "tools/cluster/arrays.h"
#include "tools/cluster/run_layout.h"
#include "tools/terminal/shell_words.h"

namespace warmjoint::inline tools {
namespace fs = std::filesystem;
namespace {

/// Keys whose values a plan needs as they are.
constexpr std::array<const char*, 6> kOwnKeys{"array",   "output", "open-mode",
                                              "requeue", "signal", "dependency"};

/// A line for sbatch; percent signs of a path are no patterns.
std::string Directive(const std::string& key, const std::string& value) {
  return fmt::format("#SBATCH --{}={}\n", key,
                     value.find(' ') == std::string::npos ? value : '"' + value + '"');
}

std::string LogPath(const fs::path& run, const char* pattern) {
  return Replaced((PlanFolder(run) / "log").string(), "%", "%%") + "/" + pattern;
}

std::string Forwarded(const Plan& plan) {
  std::string lines;
  for (const std::string& entry : plan.sbatch) {
    const std::size_t equals = entry.find('=');
    lines += Directive(entry.substr(0, equals), entry.substr(equals + 1));
  }
  return lines;
}

// the task runs beside the shell, which alone gets the signal before the limit and hands it on
constexpr const char* kBody = R"sh(
offset=${{1:-0}}
me=${{SLURM_ARRAY_JOB_ID}}_$SLURM_ARRAY_TASK_ID  # the job number alone may stand for the whole array
asked=
trap 'asked=yes; kill -TERM $task 2>/dev/null' TERM
status=137
# 137: the task was killed and not this script; the shard itself counts how often it is started in vain
while [ $status -eq 137 ]; do
  # asked to end while no task was there to be told
  [ -n "$asked" ] && status=130 && break
  {program} task {run} $((offset + SLURM_ARRAY_TASK_ID + 1)) &
  task=$!
  [ -n "$asked" ] && kill -TERM $task
  status=0
  wait $task || status=$?
  while kill -0 $task 2>/dev/null; do
    status=0
    wait $task || status=$?
  done
done

# a task that was asked before it could catch the signal had nothing to leave
[ -n "$asked" ] && [ $status -eq 143 ] && status=130

# 130: asked to end. Another task goes on from the last checkpoint, unless the job was cancelled: then it is running no
# more. A controller that is away is asked again
if [ $status -eq 130 ]; then
  for pause in 1 2 4 8 16; do
    state=$(squeue -h -j "$me" -o %T) && break
    sleep $pause
  done
  [ "$state" = RUNNING ] && scontrol requeue "$me" && sleep 60
fi
exit $status
)sh";

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

    // what the plan sets by itself must not be set twice
    if (std::find(kOwnKeys.begin(), kOwnKeys.end(), key) == kOwnKeys.end()) continue;
    Refuse({"--sbatch"}, "is '{}'; a plan sets {} itself: edit array.sbatch after --dry-run",
           Excerpt(entry), key);
  }
}

std::string ArrayScript(const Plan& plan, const fs::path& run, int most_indices) {
  // all shards of the plan, as arrays that the cluster takes
  std::vector<int> all(plan.shards.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i) + 1;
  const std::vector<JobArray> arrays = ArraysOf(all, most_indices, plan.array_parallelism);

  // how the same is submitted by hand
  std::string script = "#!/bin/bash\n";
  script += fmt::format("# Shards 1 to {} of {}. To submit them by hand:\n", plan.shards.size(),
                        run.string());
  for (const JobArray& array : arrays) {
    script += fmt::format("#   sbatch --array={} {} {}\n", array.indices,
                          JoinCommand({PlanFolder(run) / "array.sbatch"}), array.offset);
  }
  script += "#   sbatch --dependency=afterany:JOB[:JOB]... " +
            JoinCommand({PlanFolder(run) / "merge.sbatch"}) + "\n";

  // directives: what the plan sets, and what the user hands on to sbatch
  script += Directive("job-name", "warmjoint");
  script += Directive("cpus-per-task", std::to_string(plan.jobs));
  script += Forwarded(plan);
  script += Directive("array", arrays.front().indices);
  script += "#SBATCH --requeue\n" + Directive("open-mode", "append");
  script += Directive("signal", "B:TERM@60") + Directive("output", LogPath(run, "%A_%a.log"));

  // the body, with program and run as words of a shell
  return script + fmt::format(kBody, fmt::arg("program", JoinCommand({plan.program.path})),
                              fmt::arg("run", JoinCommand({run})));
}

std::string MergeScript(const Plan& plan, const fs::path& run) {
  return "#!/bin/bash\n" + Directive("job-name", "warmjoint-merge") + Forwarded(plan) +
         Directive("output", LogPath(run, "merge_%j.log")) + "\nexec " +
         JoinCommand({plan.program.path, "merge", run}) + "\n";
}

std::string ParallelRecipe(const Plan& plan, const fs::path& run) {
  return fmt::format(
      "without Slurm, by GNU parallel on this machine or with --sshloginfile on several that share "
      "the folder:\n  seq {} | parallel --retries 3 {}\n  {}\n",
      plan.shards.size(), JoinCommand({plan.program.path, "task", run}) + " {}",
      JoinCommand({plan.program.path, "merge", run}));
}

}  // namespace warmjoint::inline tools
