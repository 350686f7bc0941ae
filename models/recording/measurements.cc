#include "models/recording/measurements.h"

#include <algorithm>

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

std::vector<SampleRange> CutAt(const std::vector<Eigen::Index>& starts, Eigen::Index size) {
  std::vector<SampleRange> parts{{0, size}};
  for (const Eigen::Index start : starts) {
    parts.back().count = start - parts.back().first;
    parts.push_back({start, size - start});
  }
  return parts;
}

std::vector<SampleRange> PiecesOf(const Eigen::VectorXd& time) {
  std::vector<Eigen::Index> starts;
  for (const LogGap& gap : GapsOf(time)) starts.push_back(gap.behind);
  return CutAt(starts, time.size());
}

const SampleRange& PieceAt(const std::vector<SampleRange>& pieces, Eigen::Index n) {
  const auto behind = std::ranges::upper_bound(pieces, n, {}, &SampleRange::first);
  return *(behind == pieces.begin() ? behind : behind - 1);
}

}  // namespace warmjoint
