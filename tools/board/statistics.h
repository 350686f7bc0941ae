// Summaries of samples.
#pragma once

#include <warmjoint/suite.h>

#include <vector>

namespace warmjoint {

/// Root of the mean square of `values`; NaN among them are left out.
double RootMeanSquareOf(const std::vector<double>& values);

/// Summary of the numbers in `values`; NaN among them are left out.
Summary Summarise(std::vector<double> values);

/// The median of `differences`, which are of pairs, and its 95 % interval: that of the percentile
/// bootstrap (Efron 1979) with infinitely many resamples, which is known in closed form. Of n
/// differences drawn from n with replacement, the median (the lower one of two) is at most the k-th
/// smallest where m or more of them come from the first k, with probability I_{k/n}(m, n - m + 1),
/// m = (n + 1) / 2 rounded down, I the regularized incomplete beta function (Maritz and Jarrett 1978).
/// NaN of none.
Difference MedianDifference(std::vector<double> differences);

}  // namespace warmjoint
