// Ridge regression with the prior on the kernel weights alone.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <memory>
#include <optional>

#include "identification/model/normal_equations.h"

namespace warmjoint {

/// x(strength) = argmin |A x - y|^2 + strength |w|^2, w the last d - free entries of x, for any
/// number of strengths. The free columns are projected out; what is left is made tridiagonal once
/// (Golub and Van Loan, 8.3.1), after which each strength costs a tridiagonal solve.
class Ridge {
 public:
  /// free: number of leading columns without a prior; they must be independent of each other.
  Ridge(const NormalEquations& normal, Eigen::Index free);

  /// [d]. strength > 0.
  Eigen::VectorXd Solve(double strength) const;
  /// Trace of the hat matrix, free + sum s/(s + strength) over the eigenvalues s of what is left.
  double EffectiveParameters(double strength) const;
  /// Eigenvalues s, ascending: [d - free].
  const Eigen::VectorXd& eigenvalues() const { return eigenvalues_; }
  /// log det of the free columns' Gram matrix.
  double log_free_determinant() const { return log_free_determinant_; }

 private:
  Eigen::Index free_;
  /// [free x q] coefficients of the free columns by regression of each kernel on them
  Eigen::MatrixXd slopes_;
  Eigen::VectorXd intercept_;     // [free] the same by regression of y
  Eigen::MatrixXd basis_;         // [q x q] Q of the tridiagonal form Q T Q^T
  Eigen::VectorXd diagonal_;      // [q] of T
  Eigen::VectorXd off_diagonal_;  // [q - 1] of T
  Eigen::VectorXd right_;         // [q] Q^T of the kernels' products with y
  Eigen::VectorXd eigenvalues_;   // [q]
  double log_free_determinant_ = 0;
};

/// The prior's and the noise's precision that make the data most likely (MacKay 1992), with a flat
/// prior on the free columns: alpha = gamma / |w|^2, beta = (n - free - gamma) / |r|^2,
/// gamma = sum s/(s + alpha/beta).
struct Evidence {
  double alpha = 0;  // 1 / variance of a kernel's weight
  double beta = 0;   // 1 / variance of the noise
  double gamma = 0;  // kernels that the data determine
  double log_evidence = 0;
  double strength() const { return alpha / beta; }
};
Evidence MaximiseEvidence(const NormalEquations& normal, Eigen::Index free);

/// log evidence at given precisions:
/// 1/2 [q ln a + n ln b - b |r|^2 - a |w|^2 - ln det(b A^T A + a P) - (n - free) ln 2 pi].
double LogEvidence(const NormalEquations& normal, const Ridge& ridge, Eigen::Index free,
                   double alpha, double beta);

/// Factors A + shift I = L L^T of matrices most of whose entries are 0, for any number of shifts.
class ShiftedCholesky {
 public:
  /// matrix: [n x n], symmetric. Entries below 1e-17 of sqrt(a_ii a_jj) count as 0.
  explicit ShiftedCholesky(const Eigen::MatrixXd& matrix);

  /// False where A + shift I is not positive definite to rounding; then there is nothing to solve.
  bool Factor(double shift);
  /// (A + shift I)^-1 right, of the latest shift. right: [n x k]
  Eigen::MatrixXd Solve(const Eigen::MatrixXd& right) const { return factors_->solve(right); }

 private:
  Eigen::SparseMatrix<double> matrix_;  // [n x n]
  std::unique_ptr<Eigen::SimplicialLLT<Eigen::SparseMatrix<double>>> factors_;
};

/// x(strength) of Ridge, for kernels most pairs of which do not overlap: the kernels' Gram matrix K is
/// factored as a sparse one, the p free columns F are its border,
///   [K + s I   B] [w]   [b]
///   [B^T       F] [f] = [c].
class LocalRidge {
 public:
  /// free: p, number of leading columns without a prior.
  LocalRidge(const NormalEquations& normal, Eigen::Index free);

  /// [d]; nothing where the system is singular to rounding. strength > 0.
  std::optional<Eigen::VectorXd> Solve(double strength);

 private:
  Eigen::Index free_;
  Eigen::MatrixXd corner_;   // [p x p] F
  Eigen::VectorXd product_;  // [p] c
  Eigen::MatrixXd border_;   // [q x (p + 1)] B, b
  ShiftedCholesky kernels_;
};

/// A part of the rows that a ridge on all the others predicts.
class HeldOutPart {
 public:
  /// part: must outlive this; all: of all rows.
  HeldOutPart(const NormalEquations& part, const NormalEquations& all, Eigen::Index free)
      : part_(part), ridge_(all.Minus(part), free) {}

  /// Squared error on the part; infinite where the strength is too small to solve.
  double Squares(double strength);

 private:
  const NormalEquations& part_;
  LocalRidge ridge_;
};

}  // namespace warmjoint
