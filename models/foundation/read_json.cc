#include "models/foundation/read_json.h"

#include <algorithm>
#include <string_view>

#include "models/foundation/atomic_file.h"
#include "models/foundation/excerpt.h"

namespace warmjoint {
namespace {

Place PlaceOf(const std::string& text, std::size_t byte, const std::string& file) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(byte, text.size()));
  return {file, static_cast<int>(1 + std::count(text.begin(), end, '\n'))};
}

/// Refuses brackets within brackets beyond kDeepestJson, which code that walks the tree may not bear.
void CheckDepth(const std::string& text, const std::string& file) {
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    // brackets within texts do not count; a backslash takes the next character with it
    if (quoted) {
      if (c == '\\') ++i;
      quoted = c != '"';
    } else if (c == '"') {
      quoted = true;
    } else if (c == '[' || c == '{') {
      if (++depth <= kDeepestJson) continue;
      Refuse(PlaceOf(text, i, file), "nests deeper than {} levels; what is read here has fewer",
             kDeepestJson);
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
}

/// What a library's message quotes last: the number that it could not hold.
std::string_view Quoted(std::string_view message) {
  const std::size_t end = message.rfind('\'');
  if (end == std::string_view::npos || end == 0) return {};
  const std::size_t begin = message.rfind('\'', end - 1);
  if (begin == std::string_view::npos) return {};
  return message.substr(begin + 1, end - begin - 1);
}

}  // namespace

template <typename Json>
Json ReadJsonFile(const std::filesystem::path& path) {
  return ParseJson<Json>(ReadWholeFile(path, kLargestJson), path.string());
}

template <typename Json>
Json ParseJson(const std::string& text, const std::string& file) {
  if (const auto broken = FirstBrokenByte(text)) {
    Refuse(PlaceOf(text, *broken, file), "byte {} is not UTF-8, as JSON must be", *broken + 1);
  }
  CheckDepth(text, file);
  try {
    const auto turn = JsonTurn();
    return Json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    Refuse(PlaceOf(text, error.byte, file), "is not JSON: {}",
           Excerpt(error.what(), kLongestComplaint));
  } catch (const nlohmann::json::out_of_range& error) {
    // the library tells no place, but the number, which is looked for
    const std::string_view number = Quoted(error.what());
    Refuse(PlaceOf(text, text.find(number), file),
           "{} is beyond the largest number, 1.8e308; write null for what is unknown",
           Excerpt(number));
  }
}

template nlohmann::json ReadJsonFile(const std::filesystem::path&);
template nlohmann::ordered_json ReadJsonFile(const std::filesystem::path&);
template nlohmann::json ParseJson(const std::string&, const std::string&);
template nlohmann::ordered_json ParseJson(const std::string&, const std::string&);

}  // namespace warmjoint
