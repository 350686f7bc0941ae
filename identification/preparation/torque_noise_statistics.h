// How torque differs from one sample to the next: by noise, by steps, or not at all.
#pragma once

#include <warmjoint/recording.h>

#include <vector>

namespace warmjoint {

inline constexpr Eigen::Index kLongRun =
    20;  // kept samples of one torque; why 20: noise gives none

/// Samples in a row with exactly one torque.
struct ConstantRun {
  Eigen::Index begin = 0, end = 0;  // first sample, one past the last
  Eigen::Index kept = 0;            // of them, how many are kept
};

/// What neighbouring samples, both kept, say of the torque. Long runs do not count in the shares.
struct TorqueNoiseStatistics {
  double equal = 0;  // share of the neighbours that differ by 1e-6 of the largest |torque| at most
  double turning = 0;  // share of the samples above or below both neighbours; 2/3 in white noise
  std::vector<ConstantRun> long_runs;  // that keep kLongRun samples or more

  /// Whether torque goes up and down as noise does; what is smooth or stays in steps does not.
  bool IsNoisy() const { return turning > 0.2; }
};

TorqueNoiseStatistics MeasureTorqueNoise(const Measurements& measurements,
                                         const Selection& selection);

}  // namespace warmjoint
