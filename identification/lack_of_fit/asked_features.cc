#include "identification/lack_of_fit/asked_features.h"

#include <cmath>
#include <numeric>

#include "identification/lack_of_fit/column_products.h"
#include "identification/lack_of_fit/orthonormal.h"
#include "models/foundation/four.h"

namespace warmjoint {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Values times their roots; returns the sum of their squares. All [m].
WARMJOINT_FOR_EACH_PROCESSOR
double WriteWeighed(const double* values, const double* roots, Index m, double* to) {
  // four rows at a time, and those that are left
  Four squares = {};
  Index i = 0;
  for (; i + 4 <= m; i += 4) {
    Four value, root;
    Load(values + i, value);
    Load(roots + i, root);
    const Four weighed = value * root;
    Store(weighed, to + i);
    squares += weighed * weighed;
  }
  double sum = SumOf(squares);
  for (; i < m; ++i) {
    to[i] = values[i] * roots[i];
    sum += to[i] * to[i];
  }
  return sum;
}

}  // namespace

AskedFeatures::AskedFeatures(const VectorXd& residual, const MatrixXd& basis,
                             const std::vector<Features>& features, const VectorXd& roots,
                             const std::vector<Index>& ends)
    : rank_(basis.cols()) {
  // the table
  Index c = 1 + rank_;
  for (const Features& one : features) {
    places_.push_back({c, one.columns.cols(), one.candidates, one.period});
    c += one.columns.cols();
  }
  table_.resize(residual.size(), c);
  table_.col(0) = residual;
  table_.middleCols(1, rank_) = basis;
  for (size_t i = 0; i < features.size(); ++i) {
    WriteNormed(features[i].columns, roots, table_.middleCols(places_[i].first, places_[i].count));
  }

  // its products in each part
  by_part_ = ProductsByPart(table_, ends);

  // and over all of them
  products_.resize(c, c);
  for (Index i = 0; i < c; ++i) {
    for (Index j = i; j < c; ++j) products_(i, j) = products_(j, i) = ByPart(i, j).sum();
  }
}

OwnBasis AskedFeatures::Beside(size_t i, double distinct) const {
  // products of what the fit leaves of the features, with each other and with the residual
  const Index first = places_[i].first, q = places_[i].count;
  const auto shared = products_.block(1, first, rank_, q);
  const MatrixXd beside = products_.block(first, first, q, q) - shared.transpose() * shared;
  const VectorXd with_residual =
      products_.col(0).segment(first, q) - shared.transpose() * products_.col(0).segment(1, rank_);

  // a mix of the features, and of the fit's basis, which takes off what they share with it
  const MatrixXd mix = MixOfDistinct(beside, distinct);
  OwnBasis own;
  // nothing stands out
  if (mix.cols() == 0) return own;
  own.columns.resize(static_cast<size_t>(rank_ + q));
  std::iota(own.columns.begin(), own.columns.begin() + rank_, Index{1});
  std::iota(own.columns.begin() + rank_, own.columns.end(), first);
  own.mix.resize(rank_ + q, mix.cols());
  own.mix.topRows(rank_) = -shared * mix;
  own.mix.bottomRows(q) = mix;
  own.b = mix.transpose() * with_residual;
  return own;
}

VectorXd AskedFeatures::Shares(const OwnBasis& own) const {
  // trace(M^T K M): the entries of K, each as often as those of M M^T say
  const MatrixXd often = own.mix * own.mix.transpose();
  VectorXd shares = VectorXd::Zero(by_part_.rows());
  for (Index i = 0; i < often.rows(); ++i) {
    for (Index j = 0; j <= i; ++j) {
      const double both = i == j ? often(i, i) : 2 * often(i, j);
      shares +=
          both * ByPart(own.columns[static_cast<size_t>(i)], own.columns[static_cast<size_t>(j)]);
    }
  }
  return shares;
}

MatrixXd AskedFeatures::Scores(const OwnBasis& own) const {
  // what is left of the residual beside the fit and the own basis
  VectorXd taken = own.mix * own.b;
  taken.head(rank_) += products_.col(0).segment(1, rank_);

  // products of that with the columns, and with their mix
  MatrixXd left(by_part_.rows(), taken.size());
  for (Index i = 0; i < taken.size(); ++i) {
    const Index column = own.columns[static_cast<size_t>(i)];
    left.col(i) = ByPart(0, column);
    for (Index j = 0; j < taken.size(); ++j) {
      left.col(i) -= taken[j] * ByPart(column, own.columns[static_cast<size_t>(j)]);
    }
  }
  return left * own.mix;
}

MatrixXd AskedFeatures::Rows(const OwnBasis& own) const {
  return table_(Eigen::all, own.columns) * own.mix;
}

Eigen::RowVectorXd WriteNormed(const MatrixXd& columns, const VectorXd& roots,
                               Eigen::Ref<MatrixXd> to) {
  Eigen::RowVectorXd norms(columns.cols());
  for (Index i = 0; i < columns.cols(); ++i) {
    norms[i] = std::sqrt(
        WriteWeighed(columns.col(i).data(), roots.data(), roots.size(), to.col(i).data()));
    if (norms[i] > 0) to.col(i) *= 1 / norms[i];
  }
  return norms;
}

}  // namespace warmjoint
