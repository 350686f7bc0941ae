// Random numbers for identifiers, from which those of a simulation cannot be told.
#pragma once

#include <Random123/threefry.h>

#include <array>
#include <cstdint>

namespace warmjoint::inline models {

/// What an identifier may draw its start from: a digest that cannot be turned back into the seed,
/// of which truth, motion and noise of a simulated log are made.
struct StartKey {
  std::array<std::uint64_t, 4> digest{};

  bool operator==(const StartKey&) const = default;
};

/// Threefry 4x64-20 (Salmon et al. 2011) keyed by the digest: another family than RandomStream.
class StartStream {
 public:
  explicit StartStream(StartKey key);

  /// Uniform in [lower, upper), 53 bits.
  double Uniform(double lower, double upper);

 private:
  r123::Threefry4x64::key_type key_;
  std::uint64_t drawn_ = 0;
};

}  // namespace warmjoint::inline models
