#include "tools/cluster/plan.h"

#include <nlohmann/json.hpp>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/json_members.h"
#include "models/foundation/read_json.h"
#include "tools/cluster/run_layout.h"

namespace warmjoint::inline tools {
namespace fs = std::filesystem;

// where json finds it: not in the namespace of this file alone
NLOHMANN_JSON_SERIALIZE_ENUM(Consent, {{Consent::none, "none"},
                                       {Consent::commands, "commands"},
                                       {Consent::unconfined, "unconfined"}})

namespace {

using nlohmann::json;

constexpr int kMostShards = 1'000'000;
constexpr double kLongestCheckpoint = 86'400;  // s

/// A value for a message.
std::string Shown(const json& value) { return Excerpt(value.dump()); }

Consent ReadConsent(const json& value, const Place& place) {
  // a word, or its number, which plans may hold, too
  for (const Consent consent : {Consent::none, Consent::commands, Consent::unconfined}) {
    if (value == json(consent) || value == static_cast<int>(consent)) return consent;
  }
  Refuse(place, R"('consent' is {}; it must be "none", "commands" or "unconfined")", Shown(value));
}

json ToJson(const PinnedFile& file) { return {{"path", file.path}, {"sha256", file.sha256}}; }

/// Members of plan.json by name, each read once and checked.
class Members {
 public:
  Members(const json& object, Place place) : object_(object), place_(std::move(place)) {}

  const json& Get(const char* name) const {
    const auto found = object_.find(name);
    if (found == object_.end()) Refuse(place_, "lacks '{}'; make the plan anew", name);
    return *found;
  }
  std::string Text(const char* name) const {
    const json& value = Get(name);
    if (!value.is_string()) Refuse(place_, "'{}' is {}; it must be a text", name, Shown(value));
    return value.get<std::string>();
  }
  double Number(const char* name, double lowest, double highest) const {
    const double value = NumberFrom(Get(name), name, place_);
    if (lowest <= value && value <= highest) return value;
    Refuse(place_, "'{}' is {}; it must be from {} to {}", name, value, lowest, highest);
  }
  int Whole(const char* name, int lowest, int highest) const {
    const double value = Number(name, lowest, highest);
    if (value == static_cast<int>(value)) return static_cast<int>(value);
    Refuse(place_, "'{}' is {}; it must be a whole number", name, value);
  }
  std::vector<std::string> Texts(const char* name) const {
    const json& list = Get(name);
    if (!list.is_array()) Refuse(place_, "'{}' must be a list of texts", name);
    std::vector<std::string> texts;
    for (const json& one : list) {
      if (!one.is_string()) {
        Refuse(place_, "'{}' holds {}; it must be a list of texts", name, Shown(one));
      }
      texts.push_back(one.get<std::string>());
    }
    return texts;
  }
  std::vector<std::pair<std::string, std::string>> NamedTexts(const char* name) const {
    const json& object = Get(name);
    if (!object.is_object()) Refuse(place_, "'{}' must be an object of texts", name);
    std::vector<std::pair<std::string, std::string>> texts;
    for (const auto& [key, value] : object.items()) {
      if (!value.is_string()) {
        Refuse(place_, "'{}' of '{}' is {}; it must be a text", key, name, Shown(value));
      }
      texts.emplace_back(key, value.get<std::string>());
    }
    return texts;
  }
  PinnedFile File(const char* name) const {
    RefuseUnknownKeys(Get(name), name, {"path", "sha256"}, place_);
    const Members file(Get(name), place_);
    return {file.Text("path"), file.Text("sha256")};
  }

 private:
  const json& object_;
  Place place_;
};

std::vector<PlannedShard> ReadShards(const json& list, const Place& place) {
  if (!list.is_array() || list.empty() || list.size() > kMostShards) {
    Refuse(place, "'shards' must be a list of 1 to {} pairs [first, end]", kMostShards);
  }
  std::vector<PlannedShard> shards;
  for (const json& pair : list) {
    // two whole numbers in order, within what an int holds
    const bool fits = pair.is_array() && pair.size() == 2 && pair[0].is_number_unsigned() &&
                      pair[1].is_number_unsigned() && pair[0] <= pair[1] &&
                      pair[1] <= 1'000'000'000;
    if (!fits) Refuse(place, "'shards' holds {}, which is not a pair [first, end]", pair.dump());
    shards.push_back({pair[0].get<int>(), pair[1].get<int>()});
  }
  return shards;
}

}  // namespace

void WritePlan(const fs::path& run, const Plan& plan) {
  // all but the lists, which follow
  json file{{"id", plan.id},
            {"suite", plan.suite_yaml},
            {"directory", plan.directory},
            {"program", ToJson(plan.program)},
            {"plugin", ToJson(plan.plugin)},
            {"consent", plan.consent},
            {"jobs", plan.jobs},
            {"probe_seconds", plan.probe_seconds},
            {"checkpoint_seconds", plan.checkpoint_seconds},
            {"restarts", plan.restarts},
            {"array_parallelism", plan.array_parallelism},
            {"sbatch", plan.sbatch}};
  for (const auto& [name, value] : plan.versions) file["versions"][name] = value;
  for (const PlannedShard& shard : plan.shards) file["shards"].push_back({shard.first, shard.end});
  WriteWholeFile(PlanFile(run), file.dump(1) + "\n");
}

bool HasPlan(const fs::path& run) { return fs::exists(PlanFile(run)); }

void RefuseWithoutPlan(const fs::path& run) {
  if (HasPlan(run)) return;
  Refuse({run.string()},
         "holds no plan (slurm/plan.json is missing); give the -o of `warmjoint run --slurm` or "
         "`--local-shards`");
}

Plan ReadPlan(const fs::path& run) {
  RefuseWithoutPlan(run);
  // entries that nobody knows are mistakes of whoever edited the file
  const Place place{PlanFile(run).string()};
  const json file = ReadJsonFile(place.file);
  RefuseUnknownKeys(
      file, "the plan",
      {"id", "suite", "directory", "program", "plugin", "consent", "jobs", "probe_seconds",
       "checkpoint_seconds", "restarts", "array_parallelism", "sbatch", "versions", "shards"},
      place);
  const Members members(file, place);
  Plan plan;
  // what is run, and by which program
  plan.id = members.Text("id");
  plan.suite_yaml = members.Text("suite");
  plan.directory = members.Text("directory");
  plan.program = members.File("program");
  plan.plugin = members.File("plugin");
  plan.consent = ReadConsent(members.Get("consent"), place);

  // numbers within bounds that make sense
  plan.jobs = members.Whole("jobs", 1, 1024);
  plan.probe_seconds = members.Number("probe_seconds", 0, 1e9);
  plan.checkpoint_seconds = members.Number("checkpoint_seconds", 0.1, kLongestCheckpoint);
  plan.restarts = members.Whole("restarts", 0, 1000);
  plan.array_parallelism = members.Whole("array_parallelism", 0, kMostShards);

  // words for sbatch, versions and shards
  plan.sbatch = members.Texts("sbatch");
  plan.versions = members.NamedTexts("versions");
  plan.shards = ReadShards(members.Get("shards"), place);
  return plan;
}

}  // namespace warmjoint::inline tools
