#include "identification/model/normal_equations.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>

namespace warmjoint {
namespace {

/// Eigenvalues of a matrix scaled to a unit diagonal that are smaller count as 0.
constexpr double kNoInformation = 1e-12;  // why: the rounding of some 1e4 samples' products

struct Scaled {
  Eigen::VectorXd scale;
  Eigen::MatrixXd vectors;
  Eigen::VectorXd inverse;  // of the eigenvalues; 0 where there is no information
};

Scaled Decompose(const Eigen::MatrixXd& h) {
  Scaled found;
  found.scale = h.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(found.scale.asDiagonal() * h *
                                                              found.scale.asDiagonal());
  found.vectors = solver.eigenvectors();
  const Eigen::VectorXd& values = solver.eigenvalues();
  const double least = kNoInformation * values.tail(1)[0];
  found.inverse = (values.array() > least).select(values.cwiseMax(least).cwiseInverse(), 0.0);
  return found;
}

}  // namespace

double RoundingVariance(const Eigen::VectorXd& torque) {
  if (torque.size() == 0) return 0;
  const double error = static_cast<double>(torque.size()) * std::numeric_limits<double>::epsilon() *
                       torque.cwiseAbs().maxCoeff();
  return error * error;
}

Eigen::MatrixXd GramOf(const Eigen::MatrixXd& J) {
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(J.cols(), J.cols());
  if (J.rows() > 0) gram.selfadjointView<Eigen::Lower>().rankUpdate(J.transpose());
  gram.triangularView<Eigen::StrictlyUpper>() = gram.transpose();
  return gram;
}

Eigen::MatrixXd Cofactor(const Eigen::MatrixXd& normal) {
  const Eigen::Index p = normal.rows();

  // scaled to a diagonal of 1, so that units do not count
  const Eigen::VectorXd scale = normal.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LDLT<Eigen::MatrixXd> factors(scale.asDiagonal() * normal * scale.asDiagonal());
  // where columns cannot be distinguished, the errors have no bound
  if (!scale.allFinite() || !(factors.vectorD().minCoeff() > 1e-13)) {
    return Eigen::MatrixXd::Constant(p, p, std::numeric_limits<double>::infinity());
  }
  return scale.asDiagonal() * factors.solve(Eigen::MatrixXd::Identity(p, p)) * scale.asDiagonal();
}

Eigen::VectorXd SolveScaled(const Eigen::MatrixXd& h, const Eigen::VectorXd& b) {
  const Scaled d = Decompose(h);
  const Eigen::VectorXd in = d.vectors.transpose() * d.scale.cwiseProduct(b);
  return d.scale.cwiseProduct(d.vectors * d.inverse.cwiseProduct(in));
}

Eigen::MatrixXd InverseScaled(const Eigen::MatrixXd& h) {
  const Scaled d = Decompose(h);
  const Eigen::MatrixXd root =
      d.scale.asDiagonal() * d.vectors * d.inverse.cwiseSqrt().asDiagonal();
  return root * root.transpose();
}

NormalEquations::NormalEquations(Eigen::Index d)
    : gram(Eigen::MatrixXd::Zero(d, d)), product(Eigen::VectorXd::Zero(d)) {}

void NormalEquations::Add(const Eigen::MatrixXd& A, const Eigen::VectorXd& y) {
  gram += GramOf(A);
  product += A.transpose() * y;
  squares += y.squaredNorm();
  rows += A.rows();
}

NormalEquations NormalEquations::Plus(const NormalEquations& part) const {
  NormalEquations sum = *this;
  sum.gram += part.gram;
  sum.product += part.product;
  sum.squares += part.squares;
  sum.rows += part.rows;
  return sum;
}

NormalEquations NormalEquations::Minus(const NormalEquations& part) const {
  NormalEquations rest = *this;
  rest.gram -= part.gram;
  rest.product -= part.product;
  rest.squares -= part.squares;
  rest.rows -= part.rows;
  return rest;
}

double NormalEquations::Squares(const Eigen::VectorXd& x) const {
  return squares - 2 * x.dot(product) + x.dot(gram * x);
}

NormalEquations NormalEquations::Holding(const std::vector<Eigen::Index>& held,
                                         const Eigen::VectorXd& values) const {
  std::vector<Eigen::Index> rest;
  for (Eigen::Index i = 0; i < product.size(); ++i) {
    if (std::ranges::find(held, i) == held.end()) rest.push_back(i);
  }
  NormalEquations reduced(static_cast<Eigen::Index>(rest.size()));
  // the part that the held values explain is subtracted from the products and the squares
  reduced.gram = gram(rest, rest);
  reduced.product = product(rest) - gram(rest, held) * values;
  reduced.squares = squares - 2 * values.dot(product(held)) + values.dot(gram(held, held) * values);
  reduced.rows = rows;
  return reduced;
}

}  // namespace warmjoint
