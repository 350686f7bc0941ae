// Comparison of two identifiers on the same realizations.
#pragma once

#include "tools/board/leaderboard.h"
#include "tools/board/number_column.h"

namespace warmjoint::inline tools {

/// The median of a[i] - b[i] and its 95 % interval, that of the percentile bootstrap (Efron 1979) with
/// infinitely many resamples, which is known in closed form: of n pairs drawn from n with replacement,
/// the median (the lower one of two) is at most the k-th smallest difference where m or more of them
/// come from the first k, with probability I_{k/n}(m, n - m + 1), m = (n + 1) / 2 rounded down, I the
/// regularized incomplete beta function (Maritz and Jarrett 1978).
/// Infinite entries stand for failures; two failures differ by 0. a, b: [n], paired by i.
Difference PairedDifference(const NumberColumn& a, const NumberColumn& b);

}  // namespace warmjoint::inline tools
