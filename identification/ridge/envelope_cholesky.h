// Cholesky factorisation of matrices most of whose entries are 0.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace warmjoint {

/// Factors A + shift I = L L^T for any number of shifts. Rows and columns are put into the reverse
/// order of Cuthill and McKee (1969), which gathers what is not 0 around the diagonal; L keeps to
/// the envelope of that (George and Liu 1981, 4.2), in blocks. A matrix without zeros costs as much
/// as a dense factorisation.
class EnvelopeCholesky {
 public:
  /// matrix: [n x n], symmetric. Entries below 1e-17 of sqrt(a_ii a_jj) count as 0.
  explicit EnvelopeCholesky(const Eigen::MatrixXd& matrix);

  /// False where A + shift I is not positive definite to rounding; then there is nothing to solve.
  bool Factor(double shift);

  /// (A + shift I)^-1 right, of the latest shift. right: [n x k].
  Eigen::MatrixXd Solve(const Eigen::MatrixXd& right) const;

 private:
  Eigen::Index BlockSize(Eigen::Index begin) const;

  std::vector<Eigen::Index> order_;  // [n] column of A that stands at each place
  std::vector<Eigen::Index> end_;    // [n] one past the last row of L in each column
  Eigen::MatrixXd matrix_;           // [n x n] A in that order
  Eigen::MatrixXd factor_;           // [n x n] L below the diagonal
};

}  // namespace warmjoint
