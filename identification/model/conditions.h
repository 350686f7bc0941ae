// Normal equations under linear conditions.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace warmjoint {

/// Linear conditions on the unknowns: rows x = values.
struct Conditions {
  Eigen::MatrixXd rows;    // [k x d], independent of each other
  Eigen::VectorXd values;  // [k]

  bool operator==(const Conditions& other) const {
    // Eigen compares only matrices of equal size
    return values.size() == other.values.size() && rows == other.rows && values == other.values;
  }
};

/// gram x = product under conditions, by the projection onto what they leave.
class Conditioned {
 public:
  /// gram: [d x d]
  Conditioned(const Eigen::MatrixXd& gram, Conditions conditions);

  /// False where there is nothing to solve.
  bool works() const { return held_.info() == Eigen::Success; }
  const Conditions& conditions() const { return conditions_; }

  /// product: [d]; returns x, [d]
  Eigen::VectorXd Solve(const Eigen::VectorXd& product) const;
  /// [d x d] of rank d - k.
  Eigen::MatrixXd Inverse() const;

 private:
  Conditions conditions_;
  double firm_;
  Eigen::LLT<Eigen::MatrixXd> held_;
  Eigen::MatrixXd along_;               // [d x k]
  Eigen::LDLT<Eigen::MatrixXd> small_;  // [k x k]
};

}  // namespace warmjoint
