// Noise and resolution of a signal, read from the signal itself, and quantiles of samples.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace warmjoint {

/// Standard deviation of the white part of x, untouched by what is smooth over five samples: the
/// median of |fourth differences| / (0.6745 sqrt(70)). Jumps in less than half of the samples do
/// not count. x: [N]; 0 for fewer than five samples.
double WhiteNoise(const Eigen::VectorXd& x);

/// Which samples of a signal count. [N]
using SampleMask = Eigen::Array<bool, Eigen::Dynamic, 1>;

/// The same over the differences in whose middle a sample of `use` stands: a signal that rests shows no noise.
double WhiteNoise(const Eigen::VectorXd& x, const SampleMask& use);

/// What of x `use` has, in its order. x: [N]
Eigen::VectorXd Chosen(const Eigen::VectorXd& x, const SampleMask& use);

/// Step of a quantised signal: the smallest difference between neighbours, where all differences
/// are multiples of it (to 5 % of it) and not all the same multiple; 0 for signals that are not
/// quantised, or too finely to tell. x: [N].
double Resolution(const Eigen::VectorXd& x);

/// The value below which a share `quantile` of x lies; x is reordered. x: [N], N at least 1;
/// quantile: 0 to 1.
double QuantileInPlace(Eigen::VectorXd& x, double quantile);

/// The quantile of `sorted` (ascending) at `share` in [0, 1], linear between neighbours; NaN where
/// it is empty.
double Quantile(const std::vector<double>& sorted, double share);

/// Median of x, which is reordered. x: [N], N at least 1.
inline double MedianInPlace(Eigen::VectorXd& x) { return QuantileInPlace(x, 0.5); }

/// Median; 0 of no values.
double MedianOf(Eigen::VectorXd values);
double MedianOf(const std::vector<double>& values);

/// Median of the steps between sample times. time: [N] s, N at least 2; s.
double MedianStep(const Eigen::VectorXd& time);

}  // namespace warmjoint
