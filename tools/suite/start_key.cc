#include "tools/suite/start_key.h"

#include <fmt/format.h>

#include <string>

#include "models/foundation/sha256.h"

namespace warmjoint {

StartKey StartKeyOf(std::uint64_t seed, std::uint64_t realization) {
  const std::string digits =
      Sha256(fmt::format("warmjoint identifier start {} {}", seed, realization));
  StartKey key;
  for (size_t i = 0; i < key.digest.size(); ++i) {
    key.digest[i] = std::stoull(digits.substr(16 * i, 16), nullptr, 16);
  }
  return key;
}

}  // namespace warmjoint
