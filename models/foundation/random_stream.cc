#include "models/foundation/random_stream.h"

#include <cmath>
#include <numbers>

namespace warmjoint {

RandomStream::RandomStream(RandomKey key, Stream stream)
    : key_{{static_cast<std::uint32_t>(key.seed), static_cast<std::uint32_t>(key.seed >> 32)}},
      // counter words: running number of the block, stream, realization (low, high)
      counter_{{0, static_cast<std::uint32_t>(stream), static_cast<std::uint32_t>(key.realization),
                static_cast<std::uint32_t>(key.realization >> 32)}} {}

std::uint64_t RandomStream::Bits() {
  // four words are used up: the next block of the counter
  if (used_ == 4) {
    block_ = generator_(counter_, key_);
    ++counter_[0];
    used_ = 0;
  }
  const std::uint64_t high = block_[used_];
  const std::uint64_t low = block_[used_ + 1];
  used_ += 2;
  return (high << 32) | low;
}

double RandomStream::Uniform() { return static_cast<double>(Bits() >> 11) * 0x1.0p-53; }

double RandomStream::Normal() {
  // each draw makes two, of which this is the second
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }

  // 1 - u lies in (0, 1], so the logarithm is finite
  const double radius = std::sqrt(-2.0 * std::log(1.0 - Uniform()));
  const double angle = 2.0 * std::numbers::pi * Uniform();
  spare_ = radius * std::sin(angle);
  has_spare_ = true;
  return radius * std::cos(angle);
}

std::uint64_t RandomStream::Below(std::uint64_t n) {
  // refuse the last, incomplete block of the range, so that each number is equally likely
  const std::uint64_t limit = n * (UINT64_MAX / n);
  std::uint64_t bits = Bits();
  while (bits >= limit) bits = Bits();
  return bits % n;
}

StartStream::StartStream(StartKey key)
    : key_{{key.digest[0], key.digest[1], key.digest[2], key.digest[3]}} {}

double StartStream::Uniform(double lower, double upper) {
  const r123::Threefry4x64::ctr_type counter{{drawn_++, 0, 0, 0}};
  const std::uint64_t bits = r123::Threefry4x64()(counter, key_)[0];
  return lower + (upper - lower) * 0x1p-53 * static_cast<double>(bits >> 11);
}

}  // namespace warmjoint
