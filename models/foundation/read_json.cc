#include "models/foundation/read_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"

namespace warmjoint::inline models {

nlohmann::json ReadJsonFile(const std::filesystem::path& path) {
  const std::string text = ReadWholeFile(path);
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    const auto line =
        1 + std::count(text.begin(), text.begin() + std::min(error.byte, text.size()), '\n');
    Refuse({path, static_cast<int>(line)}, "is not JSON: {}",
           Excerpt(error.what(), kLongestComplaint));
  }
}

}  // namespace warmjoint::inline models
