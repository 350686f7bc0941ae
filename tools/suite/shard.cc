#include "tools/suite/shard.h"

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/parse_number.h"

namespace warmjoint {

Shard ReadShard(const std::string& text) {
  // whole numbers on both sides of the stroke
  if (const size_t stroke = text.find('/'); stroke != std::string::npos) {
    const auto index = ParseInteger(text.substr(0, stroke));
    const auto count = ParseInteger(text.substr(stroke + 1));
    if (index && count && 1 <= *index && *index <= *count && *count <= kMostShards) {
      return {static_cast<int>(*index), static_cast<int>(*count)};
    }
  }
  Refuse({"--shard"}, "is '{}'; give i/n with 1 <= i <= n, for example 1/4", Excerpt(text));
}

}  // namespace warmjoint
