#include "identification/maps/imitated_columns.h"

#include <cmath>

#include "identification/ridge/envelope_cholesky.h"

namespace warmjoint {
namespace {

constexpr double kImitated = 1e-3;  // share of a column's squares

}  // namespace

std::vector<Eigen::Index> ImitatedColumns(const Eigen::MatrixXd& gram, Eigen::Index free) {
  const Eigen::Index q = gram.rows() - free;
  EnvelopeCholesky kernels(gram.bottomRightCorner(q, q));
  std::vector<Eigen::Index> imitated;
  if (!kernels.Factor(1e-9 * gram.diagonal().tail(q).mean())) return imitated;
  // squares of each column that the kernels can imitate
  const Eigen::MatrixXd border = gram.bottomLeftCorner(q, free);
  const Eigen::VectorXd taken = border.cwiseProduct(kernels.Solve(border)).colwise().sum();
  // a column is imitated where hardly anything of it is left
  for (Eigen::Index j = 0; j < free; ++j) {
    if (gram(j, j) - taken[j] < kImitated * gram(j, j)) imitated.push_back(j);
  }
  return imitated;
}

std::vector<Eigen::Index> ImitatedLaw(const Eigen::MatrixXd& gram, Eigen::Index free,
                                      const std::vector<double>& lower) {
  if (lower.empty()) return {};
  std::vector<Eigen::Index> imitated = ImitatedColumns(gram, free);
  std::erase_if(imitated,
                [&](Eigen::Index j) { return !std::isfinite(lower[static_cast<size_t>(j)]); });
  return imitated;
}

}  // namespace warmjoint
