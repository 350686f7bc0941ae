#include "tools/cluster/submissions.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/read_json.h"
#include "tools/cluster/run_layout.h"

namespace warmjoint::inline tools {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

fs::path FileOf(const fs::path& run) { return PlanFolder(run) / "jobs.json"; }

void WriteSubmissions(const fs::path& run, const Submissions& submissions) {
  json file{{"arrays", json::array()}, {"merges", submissions.merges}};
  for (const SubmittedArray& one : submissions.arrays) {
    file["arrays"].push_back({{"job", one.job},
                              {"offset", one.array.offset},
                              {"indices", one.array.indices},
                              {"shards", one.array.shards}});
  }
  WriteWholeFile(FileOf(run), file.dump() + "\n");
}

/// The jobs that a merge awaits, however they end: all that is submitted now, and what earlier calls left in the queue.
std::vector<std::string> Awaited(const std::vector<SubmittedArray>& all, std::size_t earlier,
                                 const std::vector<QueuedTask>& queue) {
  std::vector<std::string> jobs;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool is_queued =
        std::ranges::any_of(queue, [&](const QueuedTask& task) { return task.job == all[i].job; });
    if (i >= earlier || is_queued) jobs.push_back(all[i].job);
  }
  return jobs;
}

/// Submits the job that merges; its number.
std::string SubmitMerge(const fs::path& run, const std::vector<std::string>& awaited) {
  std::vector<std::string> arguments;
  if (!awaited.empty()) {
    arguments.push_back(fmt::format("--dependency=afterany:{}", fmt::join(awaited, ":")));
  }
  arguments.push_back((PlanFolder(run) / "merge.sbatch").string());
  try {
    return Sbatch(arguments);
  } catch (const BadInput& refusal) {
    Refuse({run.string()},
           "the job that merges could not be submitted: {}; once the tasks have ended (see "
           "`warmjoint status {}`), `warmjoint merge {}` merges them",
           refusal.what(), run.string(), run.string());
  }
}

/// What a refusal says of the arrays before it.
std::string SubmittedBefore(const std::vector<SubmittedArray>& arrays) {
  // nothing of this call, whatever was submitted before
  if (arrays.empty()) return "nothing of it is submitted";
  std::vector<std::string> parts;
  for (const SubmittedArray& one : arrays) {
    parts.push_back(fmt::format("{} as job {}", Ranges(one.array.shards), one.job));
  }
  return fmt::format("submitted are {}", fmt::join(parts, ", "));
}

}  // namespace

std::vector<std::string> Submissions::Jobs() const {
  std::vector<std::string> jobs = merges;
  for (const SubmittedArray& one : arrays) jobs.push_back(one.job);
  return jobs;
}

Submissions ReadSubmissions(const fs::path& run) {
  Submissions submissions;
  // no file: nothing was ever submitted
  const fs::path file = FileOf(run);
  if (!fs::exists(file)) return submissions;
  try {
    const json object = ReadJsonFile(file);
    for (const json& one : object.at("arrays")) {
      submissions.arrays.push_back({one.at("job"),
                                    {one.at("offset"), one.at("indices").get<std::string>(),
                                     one.at("shards").get<std::vector<int>>()}});
    }
    object.at("merges").get_to(submissions.merges);
  } catch (const json::exception& error) {
    Refuse({file.string()}, "is no list of jobs: {}", Excerpt(error.what(), kLongestComplaint));
  }
  return submissions;
}

QueuedShards InQueue(const Submissions& submissions, const std::vector<QueuedTask>& queue) {
  // tasks of the run's own arrays; jobs that merge have no index
  QueuedShards shards;
  for (const QueuedTask& task : queue) {
    for (const SubmittedArray& one : submissions.arrays) {
      if (one.job != task.job || task.index < 0) continue;
      (task.running ? shards.running : shards.waiting).push_back(one.array.offset + task.index + 1);
    }
  }
  // both are searched by halving
  std::sort(shards.waiting.begin(), shards.waiting.end());
  std::sort(shards.running.begin(), shards.running.end());
  return shards;
}

void Submit(const fs::path& run, const Plan& plan, const std::vector<int>& shards,
            const std::vector<QueuedTask>& queue) {
  fs::create_directories(PlanFolder(run) / "log");
  // what was submitted before stays in the list
  Submissions all = ReadSubmissions(run);
  const std::size_t earlier = all.arrays.size();
  std::vector<SubmittedArray> taken;
  for (const JobArray& array : ArraysOf(shards, MostIndices(), plan.array_parallelism)) {
    try {
      // one array after the other, each written down as soon as it has a number
      const std::string job =
          Sbatch({"--array=" + array.indices, (PlanFolder(run) / "array.sbatch").string(),
                  std::to_string(array.offset)});
      taken.push_back({job, array});
    } catch (const BadInput& refusal) {
      Refuse({run.string()},
             "shards {} to {} could not be submitted: {}; {}. Once that is mended, `warmjoint "
             "status {} --resubmit` submits the rest",
             array.shards.front(), array.shards.back(), refusal.what(), SubmittedBefore(taken),
             run.string());
    }
    all.arrays.push_back(taken.back());
    WriteSubmissions(run, all);
  }

  // and the job that merges
  all.merges.push_back(SubmitMerge(run, Awaited(all.arrays, earlier, queue)));
  WriteSubmissions(run, all);
}

}  // namespace warmjoint::inline tools
