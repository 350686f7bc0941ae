// Products of values at any times with waves of many frequencies.
#pragma once

#include <Eigen/Core>

namespace warmjoint {

/// Multiples of a step: first step, (first + 1) step, ...
struct Frequencies {
  double step = 1;         // cycles in a time of 1
  Eigen::Index first = 1;  // the lowest multiple, 0 or above
  Eigen::Index count = 0;

  double At(Eigen::Index k) const { return step * static_cast<double>(first + k); }
};

/// Sums of value cos(2 pi f t) and of value sin(2 pi f t). A frequency is one of few centres and a few steps more or
/// less: cos(a +- b) = cos a cos b -+ sin a sin b, and so the sine, so that four products of matrices make all sums, at
/// two multiplications for each value and frequency. values, times: [m]; returns [count x 2].
Eigen::MatrixXd WaveProducts(const Eigen::VectorXd& values, const Eigen::VectorXd& times,
                             const Frequencies& frequencies);

/// cos and sin of angles. [m x 2]
Eigen::MatrixXd Waves(const Eigen::ArrayXd& angles);

/// cos and sin of `count` angles the same step apart, by sums of two angles. [count x 2]
Eigen::MatrixXd EvenWaves(double first, double step, Eigen::Index count);

}  // namespace warmjoint
