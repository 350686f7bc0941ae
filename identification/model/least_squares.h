// Linear least squares that reports columns which cannot be distinguished.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace warmjoint {

/// Directions of a regressor closer to each other than this count as the same: ratio of the
/// smallest to the largest singular value once every column has norm 1. For [v, sign v] it is
/// reached where the speed varies by 2 % of its mean, which is what noise does to a constant one.
inline constexpr double kIndistinct = 0.01;

/// Answer of min |A x - y|.
struct LeastSquares {
  Eigen::VectorXd solution;  // [d]; empty where columns cannot be distinguished
  Eigen::MatrixXd cofactor;  // [d x d] (A^T A)^-1; times the noise variance: the covariance
  Eigen::Index rank = 0;     // number of directions that can be distinguished
  /// columns that cannot be distinguished from each other, or are 0
  std::vector<Eigen::Index> mixed;
};

/// Solves by Householder QR of A with its columns scaled to norm 1 (Golub and Van Loan, Matrix
/// Computations, 5.3). A: [N x d], N >= d; y: [N]; both finite.
LeastSquares SolveLeastSquares(const Eigen::MatrixXd& A, const Eigen::VectorXd& y,
                               double indistinct = kIndistinct);

}  // namespace warmjoint
