#include "identification/ridge/local_rows.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>
#include <numeric>

namespace warmjoint {
namespace {

constexpr Eigen::Index kChunk = 16384;  // samples whose rows are held at once

}  // namespace

void AddGroups(const std::vector<RowGroup>& groups, const Eigen::MatrixXd& free,
               const Eigen::VectorXd& y, NormalEquations& normal) {
  const Eigen::Index p = free.cols();
  for (const RowGroup& group : groups) {
    const auto m = static_cast<Eigen::Index>(group.kernels.size());
    const Eigen::MatrixXd columns = free(group.samples, Eigen::all);
    const Eigen::VectorXd torque = y(group.samples);
    // samples of a group share their kernels, so that their products are one small dense block
    Eigen::MatrixXd own = Eigen::MatrixXd::Zero(m, m);
    if (m > 0) own.selfadjointView<Eigen::Lower>().rankUpdate(group.values.transpose());
    const Eigen::MatrixXd across = group.values.transpose() * columns;
    const Eigen::VectorXd product = group.values.transpose() * torque;

    // into the lower half
    for (Eigen::Index j = 0; j < m; ++j) {
      const Eigen::Index column = p + group.kernels[j];
      double* const below = normal.gram.col(column).data() + p;
      for (Eigen::Index i = j; i < m; ++i) below[group.kernels[i]] += own(i, j);
      normal.gram.row(column).head(p) += across.row(j);
      normal.product[column] += product[j];
    }
    // products of the free columns, and squares of the torque
    normal.gram.topLeftCorner(p, p) += columns.transpose() * columns;
    normal.product.head(p) += columns.transpose() * torque;
    normal.squares += torque.squaredNorm();
    normal.rows += torque.size();
  }
  normal.gram.triangularView<Eigen::StrictlyUpper>() = normal.gram.transpose();
}

NormalEquations LocalNormal(const std::vector<FrictionMap>& maps, const MapPoints& points,
                            const Eigen::MatrixXd& free, const Eigen::VectorXd& y,
                            Eigen::Index first, Eigen::Index last) {
  NormalEquations normal(free.cols() + KernelCount(maps));
  for (Eigen::Index begin = first; begin < last; begin += kChunk) {
    AddGroups(GroupRows(maps, points, begin, std::min(last, begin + kChunk)), free, y, normal);
  }
  return normal;
}

void AddProducts(const std::vector<RowGroup>& groups, const Eigen::Ref<const Eigen::MatrixXd>& y,
                 Eigen::MatrixXd& products) {
  const bool one = y.cols() == 1;
  for (const RowGroup& group : groups) {
    if (one) {
      products.col(0)(group.kernels) += group.values.transpose() * y.col(0)(group.samples);
    } else {
      products(group.kernels, Eigen::all) +=
          group.values.transpose() * y(group.samples, Eigen::all);
    }
  }
}

Eigen::MatrixXd LocalProducts(const std::vector<FrictionMap>& maps, const MapPoints& points,
                              const Eigen::Ref<const Eigen::MatrixXd>& y) {
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(KernelCount(maps), y.cols());
  for (Eigen::Index begin = 0; begin < y.rows(); begin += kChunk) {
    AddProducts(GroupRows(maps, points, begin, std::min(y.rows(), begin + kChunk)), y, products);
  }
  return products;
}

double LeaveOneOut(const std::vector<RowGroup>& groups, const Eigen::MatrixXd& free,
                   const Eigen::VectorXd& y, const NormalEquations& normal, double strength) {
  const Eigen::Index p = free.cols();
  const Eigen::Index d = normal.product.size();
  // fit to all samples
  Eigen::MatrixXd gram = normal.gram;
  gram.diagonal().tail(d - p).array() += strength;
  const Eigen::LLT<Eigen::MatrixXd> factors(gram);
  if (factors.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
  const Eigen::MatrixXd inverse = factors.solve(Eigen::MatrixXd::Identity(d, d));
  const Eigen::VectorXd x = inverse * normal.product;

  // h_i = a_i (A^T A + s P)^-1 a_i^T
  double squares = 0;
  for (const RowGroup& group : groups) {
    std::vector<Eigen::Index> columns(static_cast<size_t>(p));
    std::iota(columns.begin(), columns.end(), 0);
    for (const Eigen::Index kernel : group.kernels) columns.push_back(p + kernel);
    Eigen::MatrixXd rows(group.values.rows(), static_cast<Eigen::Index>(columns.size()));
    rows << free(group.samples, Eigen::all), group.values;
    // without its own sample a residual is r / (1 - h)
    const Eigen::ArrayXd residual = y(group.samples) - rows * x(columns);
    const Eigen::ArrayXd leverage =
        (rows * inverse(columns, columns)).cwiseProduct(rows).rowwise().sum();
    squares += (residual / (1 - leverage)).square().sum();
  }
  return squares / static_cast<double>(normal.rows);
}

}  // namespace warmjoint
