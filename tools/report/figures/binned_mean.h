// Means of scattered samples.
#pragma once

#include "tools/report/draw/figure.h"

namespace warmjoint::report {

/// Means of y in bins of equal width over x; NaN where a bin has fewer than 8 samples.
/// x, y: [N]; returns a line of `bins` points in the middles.
Line BinnedMean(const Eigen::VectorXd& x, const Eigen::VectorXd& y, int bins);

}  // namespace warmjoint::report
