// How the samples of a recording lie in time.
#pragma once

#include <warmjoint/recording.h>

#include <Eigen/Core>
#include <vector>

#include "models/foundation/robust_noise.h"

namespace warmjoint {

// The sampling interval of a recording is its median step throughout (MedianStep): gaps and jitter
// leave that as it is.

/// A step of more than this many sampling intervals is a gap: at least three samples in a row are
/// missing, which jitter and a lost sample or two do not make.
inline constexpr double kGapSteps = 3;

/// The longest step between samples that is no gap, s. time: [N] s, N at least 2.
inline double LongestStep(const Eigen::VectorXd& time) { return kGapSteps * MedianStep(time); }

/// Every step that is longer than LongestStep, in order of time. time: [N] s
inline std::vector<LogGap> GapsOf(const Eigen::VectorXd& time) {
  std::vector<LogGap> gaps;
  if (time.size() < 2) return gaps;
  // no step is more than so many times the shortest: none is of the median, which needs no search for that
  const auto steps = time.tail(time.size() - 1) - time.head(time.size() - 1);
  if (steps.maxCoeff() <= kGapSteps * steps.minCoeff()) return gaps;
  const double longest = LongestStep(time);
  for (Eigen::Index n = 1; n < time.size(); ++n) {
    const double length = time[n] - time[n - 1];
    if (length > longest) gaps.push_back({n, length});
  }
  return gaps;
}

}  // namespace warmjoint
