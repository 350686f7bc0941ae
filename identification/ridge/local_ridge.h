// Ridge regression on local kernels.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "identification/ridge/envelope_cholesky.h"
#include "identification/ridge/ridge.h"

namespace warmjoint {

/// x(strength) of Ridge, for kernels most pairs of which never meet: the kernels' Gram matrix K is
/// factored within its envelope, the p free columns F are its border,
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
  EnvelopeCholesky kernels_;
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
