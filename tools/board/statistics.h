// Summaries of samples.
#pragma once

#include <warmjoint/suite.h>

#include <Eigen/Core>
#include <vector>

namespace warmjoint {

/// Root of the mean square of `values`; NaN among them are left out.
double RootMeanSquareOf(const std::vector<double>& values);

/// Summary of the numbers in `values`; NaN among them are left out.
Summary Summarise(std::vector<double> values);

/// The finite ones, ascending.
std::vector<double> SortedFinite(const Eigen::VectorXd& values);

/// Median of the numbers; NaN among them are left out, and NaN where nothing is left. values: [R]
double MedianOfKnown(const Eigen::VectorXd& values);

/// Median and quartiles of all realizations at each x. All: [K].
struct QuartileCurve {
  Eigen::VectorXd x;
  Eigen::VectorXd q25;
  Eigen::VectorXd median;
  Eigen::VectorXd q75;
};

/// values: [R x K], NaN left out; x: [K].
QuartileCurve QuartilesOf(const Eigen::VectorXd& x, const Eigen::MatrixXd& values);

/// The median of `differences`, which are of pairs, and its 95 % interval: that of the percentile
/// bootstrap (Efron 1979) with infinitely many resamples, which is known in closed form. Of n
/// differences drawn from n with replacement, the median (the lower one of two) is at most the k-th
/// smallest where m or more of them come from the first k, with probability I_{k/n}(m, n - m + 1),
/// m = (n + 1) / 2 rounded down, I the regularized incomplete beta function (Maritz and Jarrett 1978).
/// NaN of none.
Difference MedianDifference(std::vector<double> differences);

}  // namespace warmjoint
