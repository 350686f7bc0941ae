#include "identification/model/ridge.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

namespace warmjoint {
namespace {

constexpr int kMostRounds = 100000;

/// Solves (T + shift) x = b by elimination without pivoting; T is symmetric, at least semidefinite.
Eigen::VectorXd SolveTridiagonal(const Eigen::VectorXd& diagonal, const Eigen::VectorXd& off,
                                 double shift, Eigen::VectorXd b) {
  const Eigen::Index q = diagonal.size();
  // elimination from the top
  Eigen::VectorXd pivot(q);
  pivot[0] = diagonal[0] + shift;
  for (Eigen::Index i = 1; i < q; ++i) {
    const double factor = off[i - 1] / pivot[i - 1];
    pivot[i] = diagonal[i] + shift - factor * off[i - 1];
    b[i] -= factor * b[i - 1];
  }
  // and back from the bottom
  b[q - 1] /= pivot[q - 1];
  for (Eigen::Index i = q - 2; i >= 0; --i) b[i] = (b[i] - off[i] * b[i + 1]) / pivot[i];
  return b;
}

}  // namespace

Ridge::Ridge(const NormalEquations& normal, Eigen::Index free) : free_(free) {
  // the coefficients of the free columns by regression of each kernel, and of the torque, on them
  const Eigen::Index q = normal.product.size() - free;
  const Eigen::LLT<Eigen::MatrixXd> factors(normal.gram.topLeftCorner(free, free));
  slopes_ = factors.solve(normal.gram.topRightCorner(free, q));
  intercept_ = factors.solve(normal.product.head(free));
  log_free_determinant_ = 2 * factors.matrixLLT().diagonal().array().log().sum();

  // kernels after the free columns were eliminated, made tridiagonal
  const Eigen::MatrixXd left =
      normal.gram.bottomRightCorner(q, q) - normal.gram.bottomLeftCorner(q, free) * slopes_;
  const Eigen::Tridiagonalization<Eigen::MatrixXd> tridiagonal(left);
  basis_ = tridiagonal.matrixQ();
  diagonal_ = tridiagonal.diagonal();
  off_diagonal_ = tridiagonal.subDiagonal();
  right_ = basis_.transpose() *
           (normal.product.tail(q) - slopes_.transpose() * normal.product.head(free));
  // the eigenvalues give determinants and effective parameters at any strength
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen;
  eigen.computeFromTridiagonal(diagonal_, off_diagonal_, Eigen::EigenvaluesOnly);
  eigenvalues_ = eigen.eigenvalues().cwiseMax(0);
}

Eigen::VectorXd Ridge::Solve(double strength) const {
  const Eigen::VectorXd weights =
      basis_ * SolveTridiagonal(diagonal_, off_diagonal_, strength, right_);
  Eigen::VectorXd x(free_ + weights.size());
  x << intercept_ - slopes_ * weights, weights;
  return x;
}

double Ridge::EffectiveParameters(double strength) const {
  return static_cast<double>(free_) +
         (eigenvalues_.array() / (eigenvalues_.array() + strength)).sum();
}

double LogEvidence(const NormalEquations& normal, const Ridge& ridge, Eigen::Index free,
                   double alpha, double beta) {
  const Eigen::VectorXd x = ridge.Solve(alpha / beta);
  const Eigen::Index q = x.size() - free;
  const auto n = static_cast<double>(normal.rows);
  const auto p = static_cast<double>(free);
  // logarithm of the determinant of all parameters' precision
  const double log_determinant = p * std::log(beta) + ridge.log_free_determinant() +
                                 (beta * ridge.eigenvalues().array() + alpha).log().sum();
  return 0.5 * (static_cast<double>(q) * std::log(alpha) + n * std::log(beta) -
                beta * normal.Squares(x) - alpha * x.tail(q).squaredNorm() - log_determinant -
                (n - p) * std::log(2 * std::numbers::pi));
}

Evidence MaximiseEvidence(const NormalEquations& normal, Eigen::Index free) {
  const Ridge ridge(normal, free);
  const auto n = static_cast<double>(normal.rows);
  const auto p = static_cast<double>(free);
  Evidence evidence;
  double strength = 1e-3 * ridge.eigenvalues().maxCoeff();
  for (int round = 0; round < kMostRounds; ++round) {
    // the data determine gamma of the weights; alpha and beta follow from gamma
    const Eigen::VectorXd x = ridge.Solve(strength);
    evidence.gamma = ridge.EffectiveParameters(strength) - p;
    evidence.alpha = evidence.gamma / x.tail(x.size() - free).squaredNorm();
    evidence.beta = (n - p - evidence.gamma) / normal.Squares(x);
    // until the strength of the prior no longer changes
    const double next = evidence.strength();
    const bool settled = std::abs(next - strength) <= 1e-12 * strength;
    strength = next;
    if (settled) break;
  }
  evidence.log_evidence = LogEvidence(normal, ridge, free, evidence.alpha, evidence.beta);
  return evidence;
}

ShiftedCholesky::ShiftedCholesky(const Eigen::MatrixXd& matrix)
    : factors_(std::make_unique<Eigen::SimplicialLLT<Eigen::SparseMatrix<double>>>()) {
  constexpr double unseen = 1e-17;
  const Eigen::VectorXd scale = matrix.diagonal().cwiseAbs().cwiseSqrt();
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
      // the diagonal gets the shift, so it is kept whatever its value
      if (i != j && std::abs(matrix(i, j)) <= unseen * scale[i] * scale[j]) continue;
      entries.emplace_back(i, j, matrix(i, j));
    }
  }
  matrix_.resize(matrix.rows(), matrix.cols());
  matrix_.setFromTriplets(entries.begin(), entries.end());
  factors_->analyzePattern(matrix_);
}

bool ShiftedCholesky::Factor(double shift) {
  factors_->setShift(shift);
  factors_->factorize(matrix_);
  return factors_->info() == Eigen::Success;
}

LocalRidge::LocalRidge(const NormalEquations& normal, Eigen::Index free)
    : free_(free),
      corner_(normal.gram.topLeftCorner(free, free)),
      product_(normal.product.head(free)),
      kernels_(normal.gram.bottomRightCorner(normal.product.size() - free,
                                             normal.product.size() - free)) {
  const Eigen::Index q = normal.product.size() - free;
  border_.resize(q, free + 1);
  border_ << normal.gram.bottomLeftCorner(q, free), normal.product.tail(q);
}

std::optional<Eigen::VectorXd> LocalRidge::Solve(double strength) {
  if (!kernels_.Factor(strength)) return std::nullopt;
  // kernels are eliminated first; the few free columns solve what is left after that
  const Eigen::MatrixXd solved = kernels_.Solve(border_);
  const auto columns = border_.leftCols(free_);
  const Eigen::MatrixXd left = corner_ - columns.transpose() * solved.leftCols(free_);
  const Eigen::LLT<Eigen::MatrixXd> factors(left);
  if (factors.info() != Eigen::Success) return std::nullopt;
  Eigen::VectorXd x(free_ + border_.rows());
  x.head(free_) = factors.solve(product_ - columns.transpose() * solved.col(free_));
  // the weights, given the free columns' coefficients
  x.tail(border_.rows()) = solved.col(free_) - solved.leftCols(free_) * x.head(free_);
  return x;
}

double HeldOutPart::Squares(double strength) {
  const std::optional<Eigen::VectorXd> x = ridge_.Solve(strength);
  return x ? part_.Squares(*x) : std::numeric_limits<double>::infinity();
}

}  // namespace warmjoint
