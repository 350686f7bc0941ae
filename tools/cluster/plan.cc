#include "tools/cluster/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/node.h"
#include "tools/suite/engine.h"

namespace warmjoint {
namespace fs = std::filesystem;
namespace {

fs::path PlanFile(const fs::path& run) { return run / "slurm" / "plan.json"; }

}  // namespace

fs::path Plan::Results(int number) const {
  return run / "shards" / fmt::format("{:06}", number) / "results.sqlite";
}

int Plan::Units(int number) const {
  const Shard shard{number, shards};
  return (shard.End(suite.realizations) - shard.First(suite.realizations)) * suite.variants();
}

std::vector<int> Plan::Open() const {
  std::vector<int> open;
  for (int number = 1; number <= shards; ++number) {
    if (!IsDone(number)) open.push_back(number);
  }
  return open;
}

bool HasPlan(const fs::path& run) { return fs::exists(PlanFile(run)); }

Plan ReadPlan(const fs::path& given) {
  Plan plan;
  plan.run = fs::absolute(given).lexically_normal();
  if (!HasPlan(plan.run)) {
    Refuse({given.string()},
           "holds no plan (slurm/plan.json is missing); give the -o of `warmjoint run --slurm` or "
           "`--local-shards`");
  }
  const Place place{PlanFile(plan.run).string()};
  const Node file = ReadJsonNode(place.file);
  file.RequireKeys({"shards"});
  const double shards = file.Require("shards", kGiveNumber).Number();
  if (!(shards >= 1 && shards <= kMostShards && shards == static_cast<int>(shards))) {
    Refuse(place, "'shards' is {}; it must be a whole number from 1 to {}", shards, kMostShards);
  }
  plan.shards = static_cast<int>(shards);
  plan.suite_yaml = ReadWholeFile(plan.suite_file());
  plan.suite = ParseSuite(plan.suite_yaml, plan.suite_file());
  return plan;
}

void WritePlan(const Plan& plan) {
  fs::create_directories(plan.folder() / "log");
  WriteWholeFile(plan.suite_file(), plan.suite_yaml);
  WriteWholeFile(PlanFile(plan.run), nlohmann::json{{"shards", plan.shards}}.dump() + "\n");
}

int DefaultShards(const Suite& suite, int jobs) {
  constexpr std::int64_t units = 1000;
  const std::int64_t all = std::int64_t{suite.realizations} * suite.variants();
  const std::int64_t shards = (all + units * jobs - 1) / (units * jobs);
  return static_cast<int>(std::min<std::int64_t>(shards, kMostShards));
}

std::vector<std::string> ShardCommand(const Plan& plan, const std::string& number,
                                      const std::vector<std::string>& more) {
  std::vector<std::string> command{
      fs::read_symlink("/proc/self/exe"),       "run", plan.suite_file(), "-o", plan.run, "--shard",
      fmt::format("{}/{}", number, plan.shards)};
  command.insert(command.end(), more.begin(), more.end());
  return command;
}

std::string Ranges(const std::vector<int>& ascending, const char* comma) {
  std::vector<std::string> ranges;
  for (std::size_t i = 0; i < ascending.size();) {
    // from one number to the last that follows it without a hole
    std::size_t last = i;
    while (last + 1 < ascending.size() && ascending[last + 1] == ascending[last] + 1) ++last;
    ranges.push_back(last == i ? std::to_string(ascending[i])
                               : fmt::format("{}-{}", ascending[i], ascending[last]));
    i = last + 1;
  }
  return fmt::format("{}", fmt::join(ranges, comma));
}

}  // namespace warmjoint
