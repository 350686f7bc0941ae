#include <warmjoint/simulation.h>

#include <nlohmann/json.hpp>

#include "models/foundation/atomic_file.h"
#include "models/foundation/json_turn.h"
#include "models/foundation/serialize.h"
#include "models/friction/friction_json.h"

namespace warmjoint {

void WriteTruth(const Truth& truth, const std::filesystem::path& path) {
  const Tree tree = WriteFields(truth);
  // one thread at a time: the writer asks for the locale
  const auto written = [&] {
    const auto turn = JsonTurn();
    return tree.dump() + "\n";
  };
  WriteWholeFile(path, written());
}

Truth ReadTruth(const std::filesystem::path& path) { return ReadAs<Truth>(ReadJsonNode(path)); }

}  // namespace warmjoint
