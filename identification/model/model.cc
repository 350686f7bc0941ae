#include "identification/model/model.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "models/friction/intervals.h"

namespace warmjoint {

using Eigen::Index;
using Eigen::VectorXd;

void LinearBlock::Fill(const VectorXd& x, ModelRows& rows) const {
  // force and derivatives of a sample at once
  const Index m = at_.size, stride = rows.derivatives.cols();
  const double* column = columns_->data() + rows.at.first * m;
  double* to = rows.derivatives.data() + at_.begin;
  for (Index i = 0; i < rows.at.count; ++i, column += m, to += stride) {
    double force = 0;
    for (Index j = 0; j < m; ++j) {
      force += column[j] * x[at_.begin + j];
      to[j] += column[j];
    }
    rows.force[i] += force;
  }
}

void GivenBlock::Fill(const VectorXd& x, ModelRows& rows) const {
  const double gain = at_.Gain(x);
  const VectorXd force = gain * given_.At(rows.at, at_.z.Of(x));
  rows.force += force;
  rows.derivatives.col(at_.log_gain) += force;
  rows.derivatives.middleCols(at_.z.begin, at_.z.size) +=
      gain * given_.directions.middleRows(rows.at.first, rows.at.count);
}

void LoadBlock::FillAlong(const VectorXd& direction, const VectorXd& x, ModelRows& rows) const {
  const Index first = rows.at.first, count = rows.at.count;
  const double gain = std::abs(at_.Gain(x)), c = x[gain_];
  const VectorXd carried = carried_.At(rows.at, at_.z.Of(x));
  const auto along = direction.segment(first, count);
  const VectorXd column = gain * carried.cwiseAbs().cwiseProduct(along);
  rows.force += c * column;
  rows.derivatives.col(gain_) += column;
  rows.derivatives.col(at_.log_gain) += c * column;
  const VectorXd slope = c * gain * carried.cwiseSign().cwiseProduct(along);
  rows.derivatives.middleCols(at_.z.begin, at_.z.size) +=
      slope.asDiagonal() * carried_.directions.middleRows(first, count);
}

void LoadBlock::Fill(const VectorXd& x, ModelRows& rows) const {
  FillAlong(direction_.of_force, x, rows);
}

void LoadBlock::FillLosses(const VectorXd& x, ModelRows& rows) const {
  FillAlong(direction_.of_losses, x, rows);
}

GroupPrior Alike(Index first, Index second, double deviation) {
  const double one = 1 / (deviation * deviation);
  return {{first, second}, Eigen::Matrix2d{{one, -one}, {-one, one}}};
}

VectorXd Model::Start() const {
  VectorXd x(size());
  for (Index i = 0; i < size(); ++i) x[i] = table[static_cast<std::size_t>(i)].X();
  return x;
}

Eigen::MatrixXd Model::PriorPrecision() const {
  Eigen::MatrixXd precision = Eigen::MatrixXd::Zero(size(), size());
  for (Index i = 0; i < size(); ++i) {
    const auto& prior = table[static_cast<std::size_t>(i)].prior;
    if (prior) precision(i, i) = 1 / (prior->deviation * prior->deviation);
  }
  for (const GroupPrior& group : groups) {
    precision(group.places, group.places) += group.precision;
  }
  return precision;
}

VectorXd Model::PriorMean() const {
  VectorXd mean = VectorXd::Zero(size());
  for (Index i = 0; i < size(); ++i) {
    const auto& prior = table[static_cast<std::size_t>(i)].prior;
    if (prior) mean[i] = prior->mean;
  }
  return mean;
}

Slice Model::Append(const std::vector<Unknown>& rows) {
  const Slice at{size(), std::ssize(rows)};
  table.insert(table.end(), rows.begin(), rows.end());
  return at;
}

ModelAt::ModelAt(const Model& model, VectorXd x) : model_(model), x_(std::move(x)) {
  if (!model.heat) return;
  holds_ = Holds(model.heat->loop->intervals(), model.heat->At(x_));
  has_own_losses_ = std::ranges::any_of(
      model.blocks, [](const auto& block) { return block->MakesHeat() && block->HasOwnLosses(); });
}

HeatState ModelAt::Begin() const { return model_.heat ? model_.heat->Begin(x_) : HeatState{}; }

HeatState ModelAt::End() const {
  HeatState state = Begin();
  ModelRows rows;
  std::vector<SampleRange> stretches = Stretches();
  stretches.back().count -= 1;  // up to the last sample
  for (const SampleRange& stretch : stretches) Along(stretch, state, rows);
  model_.heat->EnterLast(x_, state);
  return state;
}

void ModelAt::Along(const SampleRange& stretch, HeatState& state, ModelRows& rows) const {
  rows.Reset(stretch, model_.size());
  if (model_.heat) AddFriction(state, rows);
  for (const auto& block : model_.blocks) {
    if (!model_.heat || !block->MakesHeat()) block->Fill(x_, rows);
  }
}

void ModelAt::AddFriction(HeatState& state, ModelRows& rows) const {
  // the friction whose losses are at the same samples is filled once
  const auto fill = [&](bool has_own, auto&& fill_block) {
    for (const auto& block : model_.blocks) {
      if (block->MakesHeat() && block->HasOwnLosses() == has_own) fill_block(*block);
    }
  };
  fill(false, [&](const Block& block) { block.Fill(x_, rows); });
  if (!has_own_losses_) return model_.heat->Add(x_, holds_, rows, state, rows);
  ModelRows losses = rows;
  fill(true, [&](const Block& block) {
    block.Fill(x_, rows);
    block.FillLosses(x_, losses);
  });
  model_.heat->Add(x_, holds_, losses, state, rows);
}

void ModelAt::LossesAlong(const SampleRange& stretch, ModelRows& rows) const {
  rows.Reset(stretch, model_.size());
  for (const auto& block : model_.blocks) {
    if (block->MakesHeat()) block->FillLosses(x_, rows);
  }
}

std::vector<SampleRange> ModelAt::Stretches() const {
  // rows that stay in a cache, and enough of them for products of many columns
  const Index length = model_.size() <= 32 ? 256 : 2048, samples = model_.samples;
  std::vector<SampleRange> stretches;
  for (Index first = 0; first < samples; first += length) {
    stretches.push_back({first, std::min(length, samples - first)});
  }
  return stretches;
}

VectorXd ModelAt::Energy() const {
  VectorXd energy(model_.samples);
  ForEachStretch(
      [&](const ModelRows& rows) { energy.segment(rows.at.first, rows.at.count) = rows.energy; });
  return energy;
}

ModelRows ModelAt::All() const {
  ModelRows all = ModelRows::Zero({0, model_.samples}, model_.size());
  if (model_.heat) all.energy.resize(model_.samples);
  ForEachStretch([&](const ModelRows& rows) {
    if (model_.heat) all.energy.segment(rows.at.first, rows.at.count) = rows.energy;
    all.force.segment(rows.at.first, rows.at.count) = rows.force;
    all.derivatives.middleRows(rows.at.first, rows.at.count) = rows.derivatives;
  });
  return all;
}

}  // namespace warmjoint
