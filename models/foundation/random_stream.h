// Counter-based random numbers: of a simulation, and of identifiers, from which those of a simulation cannot be told.
#pragma once

#include <Random123/philox.h>
#include <Random123/threefry.h>

#include <array>
#include <cstdint>

namespace warmjoint {

/// What a stream of random numbers is for. Streams of one realization are independent, so that
/// drawing more of one leaves the others as they are.
enum class Stream : std::uint32_t {
  truth = 0,
  motion = 1,
  torque_noise = 2,
  start = 3,
  test = 4,
  velocity_noise = 5,
  position_noise = 6,
  coloured_noise = 7,
  periodic_torque = 8,
  outliers = 9,
  uneven_noise = 10,
  lost_samples = 11,
  temperature_noise = 12
};

/// Key of all the random numbers of one realization.
struct RandomKey {
  std::uint64_t seed = 0;
  std::uint64_t realization = 0;
};

/// Philox 4x32-10 (Salmon et al. 2011) keyed by the seed, counting within (realization, stream).
class RandomStream {
 public:
  RandomStream(RandomKey key, Stream stream);

  /// Uniform in [0, 1), 53 bits.
  double Uniform();
  /// Uniform in [lower, upper).
  double Uniform(double lower, double upper) { return lower + (upper - lower) * Uniform(); }
  /// Standard normal (Box-Muller, both halves used).
  double Normal();
  /// Uniform whole number in [0, n); n at least 1.
  std::uint64_t Below(std::uint64_t n);

 private:
  std::uint64_t Bits();

  r123::Philox4x32 generator_;
  r123::Philox4x32::key_type key_;
  r123::Philox4x32::ctr_type counter_;
  r123::Philox4x32::ctr_type block_{};
  int used_ = 4;  // 32-bit words of block_ already given out
  bool has_spare_ = false;
  double spare_ = 0;
};

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

}  // namespace warmjoint
