// Times without samples.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/recording/sampling.h"

namespace warmjoint::inline models {

/// A time without samples.
struct LogGap {
  Eigen::Index behind = 0;  // first sample after it
  double length = 0;        // s
};

/// Every step that is longer than LongestStep, in order of time. time: [N] s
inline std::vector<LogGap> GapsOf(const Eigen::VectorXd& time) {
  std::vector<LogGap> gaps;
  if (time.size() < 2) return gaps;
  const double longest = LongestStep(time);
  for (Eigen::Index n = 1; n < time.size(); ++n) {
    const double length = time[n] - time[n - 1];
    if (length > longest) gaps.push_back({n, length});
  }
  return gaps;
}

}  // namespace warmjoint::inline models
