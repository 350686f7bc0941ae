#include "identification/model/model_squares.h"

#include <algorithm>

namespace warmjoint {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Roots of the weights, 0 where a sample does not count. [N]
VectorXd RootsOf(const ModelSamples& samples) {
  VectorXd roots = samples.keep.cast<double>();
  if (samples.weights.size() > 0) roots.array() *= samples.weights.array().sqrt();
  return roots;
}

}  // namespace

ModelRows::Rows RowsToFit(const ModelAt& model, const ModelSamples& samples) {
  const VectorXd roots = RootsOf(samples);
  ModelRows::Rows all;
  Index next = 0;
  model.ForEachStretch([&](const ModelRows& rows) {
    const Index p = rows.derivatives.cols();
    if (next == 0) all.resize(samples.keep.count(), p + 1);
    for (Index i = 0; i < rows.at.count; ++i) {
      const Index n = rows.at.first + i;
      if (!samples.keep[n]) continue;
      all.row(next).head(p) = roots[n] * rows.derivatives.row(i);
      all(next++, p) = roots[n] * (samples.torque[n] - rows.force[i]);
    }
  });
  if (samples.transform) samples.transform->Apply(all);
  return all;
}

void AddPriors(const Model& model, const VectorXd& x, RowSums& sums) {
  const Index p = model.size();
  const MatrixXd precision = model.PriorPrecision();
  const VectorXd off = x - model.PriorMean(), pull = precision * off;
  sums.gram.topLeftCorner(p, p) += precision;
  sums.product.head(p) -= pull;
  sums.squares += off.dot(pull);
}

KeptRows::KeptRows(const Model& model, const VectorXd& x,
                   const Eigen::Array<bool, Eigen::Dynamic, 1>& keep)
    : model_(model, x), size_(model.size()), stretches_(model_.Stretches()) {
  for (Index n = 0; n < keep.size(); ++n) {
    if (keep[n]) kept_.push_back(n);
  }
  HeatState state = model_.Begin();
  ModelRows rows;
  for (const SampleRange& stretch : stretches_) {
    begins_.push_back(state);
    if (model.heat) model_.Along(stretch, state, rows);
  }
}

MatrixXd KeptRows::Between(Index first, Index last) const {
  MatrixXd all(last - first, size_);
  // from the stretch that holds the first of them
  ModelRows rows;
  for (Index done = first; done < last;) {
    const Index sample = kept_[static_cast<std::size_t>(done)];
    const auto after = std::ranges::upper_bound(stretches_, sample, {}, &SampleRange::first);
    const auto at = static_cast<std::size_t>(after - stretches_.begin() - 1);
    HeatState state = begins_[at];
    model_.Along(stretches_[at], state, rows);
    for (; done < last && kept_[static_cast<std::size_t>(done)] < rows.at.end(); ++done) {
      all.row(done - first) =
          rows.derivatives.row(kept_[static_cast<std::size_t>(done)] - rows.at.first);
    }
  }
  return all;
}

ModelSquares::ModelSquares(const Model& model, const ModelSamples& samples)
    : model_(model), samples_(samples), roots_(RootsOf(samples)) {}

RowSums ModelSquares::OfData(const VectorXd& x) {
  MoveTo(x);
  const Index p = x.size();
  return {products_.topLeftCorner(p, p), products_.col(p).head(p), products_(p, p)};
}

RowSums ModelSquares::At(const VectorXd& x, double variance) {
  RowSums sums = OfData(x);
  sums.gram /= variance;
  sums.product /= variance;
  sums.squares /= variance;
  AddPriors(model_, x, sums);
  return sums;
}

const VectorXd& ModelSquares::ResidualAt(const VectorXd& x) {
  MoveTo(x);
  return residual_;
}

void ModelSquares::MoveTo(const VectorXd& x) {
  if (x_.size() == x.size() && x_ == x) return;
  x_ = x;
  const ModelAt model(model_, x);
  if (!samples_.transform) {
    products_ = SumAlong(model);
    return;
  }
  // a transform takes all rows at once
  const ModelRows::Rows rows = RowsToFit(model, samples_);
  RowProducts products(rows.cols());
  for (const auto& row : rows.rowwise()) products.Next() = row;
  products_ = products.Sums();
}

MatrixXd ModelSquares::SumAlong(const ModelAt& model) {
  const Index p = x_.size();
  residual_.resize(model_.samples);
  RowProducts products(p + 1);
  model.ForEachStretch([&](const ModelRows& rows) {
    for (Index i = 0; i < rows.at.count; ++i) {
      const Index n = rows.at.first + i;
      residual_[n] = samples_.torque[n] - rows.force[i];
      const double root = roots_[n];
      if (root == 0) continue;
      auto next = products.Next();
      for (Index j = 0; j < p; ++j) next[j] = root * rows.derivatives(i, j);
      next[p] = root * residual_[n];
    }
  });
  return products.Sums();
}

}  // namespace warmjoint
