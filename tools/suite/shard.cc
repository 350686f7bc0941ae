#include "tools/suite/shard.h"

#include <cstdint>
#include <optional>
#include <utility>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/parse_number.h"

namespace warmjoint::inline tools {
namespace {

/// The whole numbers on both sides of a mark, where the text is that.
std::optional<std::pair<std::int64_t, std::int64_t>> ReadPair(const std::string& text, char mark) {
  const size_t at = text.find(mark);
  if (at == std::string::npos) return std::nullopt;
  const auto left = ParseInteger(text.substr(0, at));
  const auto right = ParseInteger(text.substr(at + 1));
  if (!left || !right) return std::nullopt;
  return std::pair{*left, *right};
}

}  // namespace

Shard ReadShard(const std::string& text) {
  constexpr std::int64_t most_shards = 1'000'000, most_realizations = 1'000'000'000;
  // one of several parts
  if (const auto part = ReadPair(text, '/')) {
    const auto [index, count] = *part;
    if (1 <= index && index <= count && count <= most_shards) {
      return {static_cast<int>(index), static_cast<int>(count)};
    }
  }
  // or a range of realizations
  if (const auto range = ReadPair(text, ':')) {
    const auto [first, end] = *range;
    if (0 <= first && first <= end && end <= most_realizations) {
      return {1, 1, static_cast<int>(first), static_cast<int>(end)};
    }
  }
  Refuse({"--shard"},
         "is '{}'; give i/n with 1 <= i <= n, for example 1/4, or the realizations from:to, for "
         "example 0:250",
         Excerpt(text));
}

}  // namespace warmjoint::inline tools
