#include "tools/report/figures/binned_mean.h"

#include <algorithm>
#include <cmath>

#include "tools/report/figures/axes.h"

namespace warmjoint::report {

Line BinnedMean(const Eigen::VectorXd& x, const Eigen::VectorXd& y, int bins) {
  constexpr int kFewest = 8;
  const auto [lower, upper] = RangeOf({x});
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(bins), count = sum;
  // sum and number of the samples in each bin
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double share = upper > lower ? (x[i] - lower) / (upper - lower) : 0;
    const int bin = std::min(bins - 1, static_cast<int>(share * bins));
    sum[bin] += y[i];
    ++count[bin];
  }
  // a bin with few samples is a gap in the line
  Line line{Eigen::VectorXd(bins), Eigen::VectorXd(bins), 2.0};
  for (int bin = 0; bin < bins; ++bin) {
    line.x[bin] = lower + (upper - lower) * (bin + 0.5) / bins;
    line.y[bin] = count[bin] < kFewest ? std::nan("") : sum[bin] / count[bin];
  }
  return line;
}

}  // namespace warmjoint::report
