#include "identification/model/model.h"

#include <algorithm>
#include <cmath>

namespace warmjoint {

using Eigen::Index;
using Eigen::VectorXd;

void LinearBlock::Fill(const VectorXd& x, ModelRows& rows) const {
  rows.force += columns_ * at_.Of(x);
  rows.derivatives.middleCols(at_.begin, at_.size) += columns_;
}

void GivenBlock::Fill(const VectorXd& x, ModelRows& rows) const {
  const double gain = at_.Gain(x);
  const VectorXd force = gain * given_.At(at_.z.Of(x));
  rows.force += force;
  rows.derivatives.col(at_.log_gain) += force;
  rows.derivatives.middleCols(at_.z.begin, at_.z.size) += gain * given_.directions;
}

void LoadBlock::Fill(const VectorXd& x, ModelRows& rows) const {
  const double gain = std::abs(at_.Gain(x)), c = x[gain_];
  const VectorXd carried = carried_.At(at_.z.Of(x));
  const VectorXd column = gain * carried.cwiseAbs().cwiseProduct(direction_);
  rows.force += c * column;
  rows.derivatives.col(gain_) += column;
  rows.derivatives.col(at_.log_gain) += c * column;
  const VectorXd slope = c * gain * carried.cwiseSign().cwiseProduct(direction_);
  rows.derivatives.middleCols(at_.z.begin, at_.z.size) += slope.asDiagonal() * carried_.directions;
}

VectorXd HeatBlock::Fill(const VectorXd& x, const ModelRows& friction, ModelRows& rows) const {
  const double k = x[gain], tau = std::exp(x[log_time_constant]);
  const double pole = std::exp(-step / tau), cooling = 1 - pole;
  const Index n = speed.size();
  // the level of friction, which brakes or is 0
  VectorXd level = sign.cwiseProduct(friction.force);
  const VectorXd counts = (level.array() > 0).select(sign, 0.0);
  level = level.cwiseMax(0.0);

  // E[n+1] = decay[n] E[n] + fed[n]
  const VectorXd fed = cooling * k * speed;
  VectorXd energy(n);
  std::vector<bool> starts_at(static_cast<std::size_t>(n), false);
  for (const Index start : starts) starts_at[static_cast<std::size_t>(start)] = true;
  const auto scan = [&](const auto& input, auto&& state) {
    double s = 0;
    for (Index i = 0; i < n; ++i) {
      if (starts_at[static_cast<std::size_t>(i)]) s = 0;
      state[i] = s;
      s = (pole + fed[i]) * s + input(i);
    }
  };
  scan([&](Index i) { return fed[i] * level[i]; }, energy);

  // its derivatives by the unknowns of the level, by k and by log tau
  VectorXd slope(n);
  const auto add = [&](Index column, const auto& input) {
    scan(input, slope);
    rows.derivatives.col(column) += direction.cwiseProduct(slope);
  };
  for (Index p = 0; p < friction.derivatives.cols(); ++p) {
    const auto by = friction.derivatives.col(p);
    if (by.isZero(0)) continue;
    add(p, [&](Index i) { return fed[i] * counts[i] * by[i]; });
  }
  add(gain, [&](Index i) { return cooling * speed[i] * (level[i] + energy[i]); });
  const double bend = pole * step / tau;
  add(log_time_constant,
      [&](Index i) { return bend * (energy[i] - k * speed[i] * (level[i] + energy[i])); });
  rows.force += direction.cwiseProduct(energy);
  return energy;
}

VectorXd Model::Start() const {
  VectorXd x(size());
  for (Index i = 0; i < size(); ++i) x[i] = table[static_cast<std::size_t>(i)].start;
  return x;
}

VectorXd Model::PriorPrecision() const {
  VectorXd precision = VectorXd::Zero(size());
  for (Index i = 0; i < size(); ++i) {
    const auto& prior = table[static_cast<std::size_t>(i)].prior;
    if (prior) precision[i] = 1 / (prior->deviation * prior->deviation);
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

ModelRows Model::Evaluate(const VectorXd& x, VectorXd* energy) const {
  ModelRows rows{VectorXd::Zero(samples), Eigen::MatrixXd::Zero(samples, size())};
  if (!heat) {
    for (const auto& block : blocks) block->Fill(x, rows);
    return rows;
  }
  // friction first, whose loss the heat needs
  for (const auto& block : blocks) {
    if (block->MakesHeat()) block->Fill(x, rows);
  }
  const ModelRows friction = rows;
  const VectorXd found = heat->Fill(x, friction, rows);
  if (energy) *energy = found;
  for (const auto& block : blocks) {
    if (!block->MakesHeat()) block->Fill(x, rows);
  }
  return rows;
}

}  // namespace warmjoint
