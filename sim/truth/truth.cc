#include <fmt/format.h>
#include <warmjoint/simulation.h>

#include <nlohmann/json.hpp>

#include "models/foundation/atomic_file.h"
#include "models/foundation/node.h"
#include "models/foundation/serialize.h"

namespace warmjoint {

void WriteTruth(const Truth& truth, const std::filesystem::path& path) {
  const Tree tree = WriteFields(truth);
  // one thread at a time: the writer asks for the locale; parameters first, a line for each array
  const auto written = [&] {
    const auto turn = JsonTurn();
    std::string text;
    for (const auto& [name, value] : tree.items()) {
      text += fmt::format("{} \"{}\": {}", text.empty() ? "{\n" : ",\n", name, value.dump());
    }
    return text + "\n}\n";
  };
  WriteWholeFile(path, written());
}

Truth ReadTruth(const std::filesystem::path& path) { return ReadAs<Truth>(ReadJsonNode(path)); }

}  // namespace warmjoint
