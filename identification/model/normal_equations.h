// Sums over the rows of a least-squares problem, and their factors.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace warmjoint {

/// Variance that the rounding of doubles leaves in the residual of an exact torque: sums over n samples carry errors of
/// some sqrt(n) units in the last digit of the largest (Higham, Accuracy and Stability, 2002, 3.1). A smaller residual is
/// neither noise nor structure. torque: [n] N.m or N
double RoundingVariance(const Eigen::VectorXd& torque);

/// J^T J, [p x p]. J: [n x p]
Eigen::MatrixXd GramOf(const Eigen::MatrixXd& J);

/// The inverse of normal equations J^T J [p x p], formed with columns scaled to norm 1; infinite
/// throughout where they are singular to rounding.
Eigen::MatrixXd Cofactor(const Eigen::MatrixXd& normal);

/// x = H^-1 b of a positive semidefinite H of any scale; directions in which H is 0 stay 0.
Eigen::VectorXd SolveScaled(const Eigen::MatrixXd& h, const Eigen::VectorXd& b);
/// The pseudoinverse in the same sense.
Eigen::MatrixXd InverseScaled(const Eigen::MatrixXd& h);

/// Normal equations of y = A x + e; sums over rows, so that those of parts add up and those of
/// millions of samples fit into d^2 numbers.
struct NormalEquations {
  Eigen::MatrixXd gram;     // [d x d] A^T A
  Eigen::VectorXd product;  // [d] A^T y
  double squares = 0;       // y^T y
  Eigen::Index rows = 0;

  explicit NormalEquations(Eigen::Index d);
  /// Adds rows. A: [n x d]; y: [n].
  void Add(const Eigen::MatrixXd& A, const Eigen::VectorXd& y);
  NormalEquations Plus(const NormalEquations& part) const;
  NormalEquations Minus(const NormalEquations& part) const;
  /// |y - A x|^2.
  double Squares(const Eigen::VectorXd& x) const;
  /// Those of y - A_held values = A_rest x: the unknowns of the columns `held`, ascending, are known.
  NormalEquations Holding(const std::vector<Eigen::Index>& held,
                          const Eigen::VectorXd& values) const;
};

}  // namespace warmjoint
