// Huber's loss in place of squares.
#pragma once

#include <Eigen/Core>
#include <string>

namespace warmjoint {

/// Where Huber's loss turns from squares to lines, in standard deviations: 95 % as efficient as
/// squares on normal noise (Huber and Ronchetti, Robust Statistics, 2009, 4.5).
inline constexpr double kHuberBend = 1.345;

/// The residual at which the loss turns from squares to lines: kHuberBend times 1.4826 times their median size, which is
/// the standard deviation of normal noise. residual: [n] N.m or N.
double HuberThreshold(const Eigen::VectorXd& residual);

/// Weights by which squares become that loss: min(1, threshold / |r|). [n]
Eigen::VectorXd HuberWeights(const Eigen::VectorXd& residual, double threshold);

/// psi(r) / mean(psi'), [n], which takes the place of the residual for a fit under that loss. With it the
/// covariance of the estimate has the form of that of squares (ibid., 7.6), for coloured noise as
/// well. residual: [n]; with an infinite threshold the result is the residual.
Eigen::VectorXd HuberScores(const Eigen::VectorXd& residual, double threshold);

/// "; 12 of 3600 samples lie more than 4 standard deviations off, which Huber's loss bounds"; empty
/// for an infinite threshold. residual: [n] N.m or N.
std::string DescribeLoss(const Eigen::VectorXd& residual, double threshold);

}  // namespace warmjoint
