// Ripple over the motor's turn as harmonics.
#pragma once

#include <warmjoint/friction.h>

#include <Eigen/Core>
#include <vector>

namespace warmjoint {

/// amplitude cos(multiple motor angle - phase), the mean of the map over its other axes.
struct MotorHarmonic {
  int multiple = 0;
  double amplitude = 0;     // N.m or N
  double significance = 0;  // z^T cov(z)^-1 z, z = (cosine, sine part): chi-square of 2 freedoms
};

/// Harmonics of a map whose first axis is the motor position, 1 to half its kernels, one mean for
/// each direction of motion: index 0 for v < 0, 1 for v > 0. covariance: [q x q] of the weights.
std::vector<MotorHarmonic> MotorHarmonics(const FrictionMap& map, const Eigen::MatrixXd& covariance,
                                          int direction);

/// The harmonics that stand out of the noise and are at least a fifth of the strongest, strongest
/// first. A chi-square of 2 freedoms exceeds 23 by chance once in 100 000 times.
std::vector<MotorHarmonic> DominantHarmonics(std::vector<MotorHarmonic> harmonics);

}  // namespace warmjoint
