#include "models/recording/measurements.h"

namespace warmjoint {

std::vector<LogGap> GapsOf(const Eigen::VectorXd& time) {
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
