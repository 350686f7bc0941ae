#include "models/foundation/start_stream.h"

namespace warmjoint::inline models {

StartStream::StartStream(StartKey key)
    : key_{{key.digest[0], key.digest[1], key.digest[2], key.digest[3]}} {}

double StartStream::Uniform(double lower, double upper) {
  const r123::Threefry4x64::ctr_type counter{{drawn_++, 0, 0, 0}};
  const std::uint64_t bits = r123::Threefry4x64()(counter, key_)[0];
  return lower + (upper - lower) * 0x1p-53 * static_cast<double>(bits >> 11);
}

}  // namespace warmjoint::inline models
