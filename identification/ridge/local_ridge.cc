#include "identification/ridge/local_ridge.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

namespace warmjoint {

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
  // kernels are eliminated first; the few free columns solve what is left beside them
  const Eigen::MatrixXd solved = kernels_.Solve(border_);
  const auto columns = border_.leftCols(free_);
  const Eigen::MatrixXd left = corner_ - columns.transpose() * solved.leftCols(free_);
  const Eigen::LLT<Eigen::MatrixXd> factors(left);
  if (factors.info() != Eigen::Success) return std::nullopt;
  Eigen::VectorXd x(free_ + border_.rows());
  x.head(free_) = factors.solve(product_ - columns.transpose() * solved.col(free_));
  // weights that suit the free columns
  x.tail(border_.rows()) = solved.col(free_) - solved.leftCols(free_) * x.head(free_);
  return x;
}

double HeldOutPart::Squares(double strength) {
  const std::optional<Eigen::VectorXd> x = ridge_.Solve(strength);
  return x ? part_.Squares(*x) : std::numeric_limits<double>::infinity();
}

}  // namespace warmjoint
