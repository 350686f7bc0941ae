#include "sim/truth/truth_json.h"

#include <nlohmann/json.hpp>

#include "models/foundation/atomic_file.h"
#include "models/foundation/json_turn.h"
#include "models/foundation/serialize.h"
#include "models/friction/friction_json.h"

namespace warmjoint::inline sim {

Tree TruthToTree(const Truth& truth) { return WriteFields(truth); }

Truth TruthFrom(const Node& node) { return ReadAs<Truth>(node); }

void WriteTruth(const Truth& truth, const std::filesystem::path& path) {
  const Tree tree = TruthToTree(truth);
  // one thread at a time: the writer asks for the locale
  const auto written = [&] {
    const auto turn = JsonTurn();
    return tree.dump() + "\n";
  };
  WriteWholeFile(path, written());
}

Truth ReadTruth(const std::filesystem::path& path) { return TruthFrom(ReadJsonNode(path)); }

}  // namespace warmjoint::inline sim
