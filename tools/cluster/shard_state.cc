#include "tools/cluster/shard_state.h"

#include <chrono>
#include <nlohmann/json.hpp>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/read_json.h"

namespace warmjoint::inline tools {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

constexpr const char* kFile = "state.json";
constexpr std::size_t kLongestWords = 400;

}  // namespace

NLOHMANN_JSON_SERIALIZE_ENUM(Phase, {{Phase::interrupted, "interrupted"},
                                     {Phase::running, "running"},
                                     {Phase::failed, "failed"},
                                     {Phase::done, "done"}})

std::optional<ShardState> ReadShardState(const fs::path& folder) {
  const fs::path file = folder / kFile;
  if (!fs::exists(file)) return std::nullopt;
  try {
    // every member must be there
    const json object = ReadJsonFile(file);
    ShardState state;
    object.at("phase").get_to(state.phase);
    object.at("finished").get_to(state.finished);
    object.at("total").get_to(state.total);
    object.at("failures").get_to(state.failures);
    object.at("rate").get_to(state.rate);
    object.at("starts").get_to(state.starts);
    object.at("idle_starts").get_to(state.idle_starts);
    object.at("owner").get_to(state.owner);
    object.at("host").get_to(state.host);
    object.at("updated").get_to(state.updated);
    object.at("last_words").get_to(state.last_words);
    return state;
  } catch (const json::exception& error) {
    Refuse({file.string()}, "is no state of a shard: {}", Excerpt(error.what(), kLongestComplaint));
  }
}

void WriteShardState(const fs::path& folder, const ShardState& state) {
  const json object{{"phase", state.phase},
                    {"finished", state.finished},
                    {"total", state.total},
                    {"failures", state.failures},
                    {"rate", state.rate},
                    {"starts", state.starts},
                    {"idle_starts", state.idle_starts},
                    {"owner", state.owner},
                    {"host", state.host},
                    {"updated", state.updated},
                    {"last_words", Excerpt(state.last_words, kLongestWords)}};
  WriteWholeFile(folder / kFile, object.dump(1) + "\n");
}

void Forgive(const fs::path& folder) {
  // a shard that never started needs nothing
  auto state = ReadShardState(folder);
  if (!state) return;
  state->phase = Phase::interrupted;
  state->idle_starts = 0;
  WriteShardState(folder, *state);
}

double Now() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

double Patience(double checkpoint_seconds) { return 3 * checkpoint_seconds + 15; }

}  // namespace warmjoint::inline tools
