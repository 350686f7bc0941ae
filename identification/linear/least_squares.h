// Linear least squares that says when its answer is void, and Huber's loss in the place of squares.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace warmjoint {

/// Directions of a regressor closer to each other than this count as the same: ratio of the
/// smallest to the largest singular value once every column has norm 1. For [v, sign v] it is
/// reached where the speed varies by 2 % of its mean, which is what noise does to a constant one.
inline constexpr double kIndistinct = 0.01;

/// Answer of min |A x - y|.
struct LeastSquares {
  Eigen::VectorXd solution;         // [d]; empty where columns cannot be told apart
  Eigen::MatrixXd cofactor;         // [d x d] (A^T A)^-1; times the noise variance: the covariance
  Eigen::Index rank = 0;            // number of directions that can be told apart
  std::vector<Eigen::Index> mixed;  // columns that cannot be told apart from each other, or are 0
};

/// Solves by Householder QR of A with its columns scaled to norm 1 (Golub and Van Loan, Matrix
/// Computations, 5.3). A: [N x d], N >= d; y: [N]; both finite.
LeastSquares SolveLeastSquares(const Eigen::MatrixXd& A, const Eigen::VectorXd& y,
                               double indistinct = kIndistinct);

/// J^T J, [p x p]. J: [n x p]
Eigen::MatrixXd GramOf(const Eigen::MatrixXd& J);

/// The inverse of normal equations J^T J [p x p], formed with columns scaled to norm 1; infinite
/// throughout where they are singular to rounding.
Eigen::MatrixXd Cofactor(const Eigen::MatrixXd& normal);

/// Where Huber's loss turns from squares to lines, in standard deviations: 95 % as efficient as
/// squares on normal noise (Huber and Ronchetti, Robust Statistics, 2009, 4.5).
inline constexpr double kHuberBend = 1.345;

/// Where the loss of residuals bends: kHuberBend times 1.4826 times their median size, which is
/// the standard deviation of normal noise. residual: [n] N.m or N.
double HuberThreshold(const Eigen::VectorXd& residual);

/// Weights by which squares become that loss: min(1, threshold / |r|). [n]
Eigen::VectorXd HuberWeights(const Eigen::VectorXd& residual, double threshold);

/// psi(r) / mean(psi'), [n]: what a fit under that loss has in place of a residual. With it the
/// covariance of the estimate has the form of that of squares (ibid., 7.6), for coloured noise as
/// well. residual: [n]; an infinite threshold gives it back.
Eigen::VectorXd HuberScores(const Eigen::VectorXd& residual, double threshold);

/// "; 12 of 3600 samples lie more than 4 standard deviations off, which Huber's loss bounds"; empty
/// for an infinite threshold. residual: [n] N.m or N.
std::string DescribeLoss(const Eigen::VectorXd& residual, double threshold);

}  // namespace warmjoint
