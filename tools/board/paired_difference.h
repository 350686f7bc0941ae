// Comparison of two identifiers on the same realizations.
#pragma once

#include <vector>

#include "tools/board/leaderboard.h"

namespace warmjoint::inline tools {

/// The median of a[i] - b[i] and its 95 % interval: the quantiles of the medians of 1000 samples
/// drawn from the pairs with replacement (percentile bootstrap, Efron 1979), always the same ones.
/// Infinite entries stand for failures; two failures differ by 0. a, b: [n], paired by i.
Difference PairedDifference(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace warmjoint::inline tools
