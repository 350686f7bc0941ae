#include "identification/model/conditions.h"

#include <utility>

namespace warmjoint {

Conditioned::Conditioned(const Eigen::MatrixXd& gram, Conditions conditions)
    : conditions_(std::move(conditions)), firm_(gram.diagonal().mean()) {
  const Eigen::MatrixXd& rows = conditions_.rows;
  if (rows.rows() == 0) {
    held_.compute(gram);
    return;
  }
  // a large diagonal is added along the conditions, which changes nothing where they hold
  held_.compute(gram + firm_ * rows.transpose() * rows);
  along_ = held_.solve(rows.transpose());
  small_.compute(rows * along_);
}

Eigen::VectorXd Conditioned::Solve(const Eigen::VectorXd& product) const {
  const auto& [rows, values] = conditions_;
  if (rows.rows() == 0) return held_.solve(product);
  const Eigen::VectorXd x = held_.solve(product + firm_ * rows.transpose() * values);
  return x - along_ * small_.solve(rows * x - values);
}

Eigen::MatrixXd Conditioned::Inverse() const {
  const Eigen::Index d = held_.rows();
  const Eigen::MatrixXd whole = held_.solve(Eigen::MatrixXd::Identity(d, d));
  if (conditions_.rows.rows() == 0) return whole;
  return whole - along_ * small_.solve(along_.transpose());
}

}  // namespace warmjoint
