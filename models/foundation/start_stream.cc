#include "models/foundation/start_stream.h"

#include <fmt/format.h>

#include <string>

#include "models/foundation/sha256.h"

namespace warmjoint::inline models {

StartKey StartKeyOf(std::uint64_t seed, std::uint64_t realization) {
  const std::string digits =
      Sha256(fmt::format("warmjoint identifier start {} {}", seed, realization));
  StartKey key;
  for (size_t i = 0; i < key.digest.size(); ++i) {
    key.digest[i] = std::stoull(digits.substr(16 * i, 16), nullptr, 16);
  }
  return key;
}

StartStream::StartStream(StartKey key)
    : key_{{key.digest[0], key.digest[1], key.digest[2], key.digest[3]}} {}

double StartStream::Uniform(double lower, double upper) {
  const r123::Threefry4x64::ctr_type counter{{drawn_++, 0, 0, 0}};
  const std::uint64_t bits = r123::Threefry4x64()(counter, key_)[0];
  return lower + (upper - lower) * 0x1p-53 * static_cast<double>(bits >> 11);
}

}  // namespace warmjoint::inline models
