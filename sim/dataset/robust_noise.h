// Noise and resolution of a signal, read from the signal itself.
#pragma once

#include <Eigen/Core>

namespace warmjoint {

/// Standard deviation of the white part of x, untouched by what is smooth over five samples: the
/// median of |fourth differences| / (0.6745 sqrt(70)). Jumps in less than half of the samples do
/// not count. x: [N]; 0 for fewer than five samples.
double WhiteNoise(const Eigen::VectorXd& x);

/// Step of a quantised signal: the smallest difference between neighbours, where all differences
/// are multiples of it (to 5 % of it) and not all the same multiple; 0 for signals that are not
/// quantised, or too finely to tell. x: [N].
double Resolution(const Eigen::VectorXd& x);

/// Median of x, which is reordered. x: [N], N at least 1.
double MedianInPlace(Eigen::VectorXd& x);

}  // namespace warmjoint
