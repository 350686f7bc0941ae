#include "tools/suite/shard.h"

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/parse_number.h"

namespace warmjoint::inline tools {

Shard ReadShard(const std::string& text) {
  const size_t slash = text.find('/');
  if (slash != std::string::npos) {
    const auto index = ParseInteger(text.substr(0, slash));
    const auto count = ParseInteger(text.substr(slash + 1));
    if (index && count && 1 <= *index && *index <= *count && *count <= 1'000'000) {
      return {static_cast<int>(*index), static_cast<int>(*count)};
    }
  }
  Refuse({"--shard"}, "is '{}'; give i/n with 1 <= i <= n, for example 1/4", Excerpt(text));
}

}  // namespace warmjoint::inline tools
