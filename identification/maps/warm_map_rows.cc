#include "identification/maps/warm_map_rows.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "identification/fit_data.h"
#include "identification/linear/rigid_part.h"
#include "identification/maps/local_rows.h"

namespace warmjoint {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

WarmMapRows::WarmMapRows(const IdentifierInput& input, WarmMapParts parts)
    : m_(input.measurements),
      parts_(std::move(parts)),
      points_(PointsOf(m_)),
      law_(LawColumns(parts_.law, m_.velocity)),
      of_loss_(LossColumns(parts_.law, m_)),
      loop_(ClosedLoop::Along(m_, MatrixXd(m_.size(), 0)).WithJumps(parts_.jump_samples)),
      torque_(Kept(m_.torque, input.selection)) {
  for (Index n = 0; n < m_.size(); ++n) {
    if (input.selection.keep[n]) kept_.push_back(n);
  }
  const Layout& at = parts_.layout;
  const Index of_law = at.law.size + at.weights.size;
  loop_size_ = of_law + 3 + at.jumps.size;
  order_.resize(static_cast<size_t>(at.size()));
  const auto place = [&](const Slice& part, Index first) {
    std::iota(order_.begin() + part.begin, order_.begin() + part.end(), first);
  };
  place(at.law, 0);
  place(at.weights, at.law.size);
  place(at.heat, of_law);
  place(at.start, of_law + 2);
  place(at.jumps, of_law + 3);
  place(at.rigid, loop_size_);
}

double WarmMapRows::InitialEnergy() const {
  return parts_.layout.start.size > 0 ? x_[parts_.layout.energy()] : 0;
}

ClosedLoop::Rows WarmMapRows::Along(Index first, Index last, LoopEnd& at) const {
  const Layout& layout = parts_.layout;
  const Index size = last - first;
  const MatrixXd kernels = DenseKernels(parts_.maps, points_, first, last);
  LoopColumns columns{first, ConcatColumns(law_.middleRows(first, size), kernels)};
  if (of_loss_.size() > 0) {
    columns.loss = ConcatColumns(of_loss_.middleRows(first, size), kernels);
  }
  VectorXd parameters(layout.law.size + layout.weights.size);
  parameters << layout.law.Of(x_), layout.weights.Of(x_);
  ClosedLoop::Rows slopes =
      loop_.SlopesAlong(columns, parameters, layout.ThermalAt(x_), layout.jumps.Of(x_), at);
  if (layout.rigid.size == 0) return slopes;
  ClosedLoop::Rows rows(size, loop_size_ + layout.rigid.size);
  rows << slopes, parts_.rigid.middleRows(first, size);
  return rows;
}

void WarmMapRows::MoveTo(const VectorXd& x) {
  if (x_.size() == x.size() && x_ == x) return;
  x_ = x;
  const Layout& layout = parts_.layout;
  squares_ = 0;
  begins_.clear();
  const Index all = loop_size_ + layout.rigid.size;
  MatrixXd gram = MatrixXd::Zero(all, all);
  VectorXd product = VectorXd::Zero(all);
  // the force is linear in all but the heat
  VectorXd linear = VectorXd::Zero(all);
  linear(order_) = x;
  linear.segment(layout.law.size + layout.weights.size, 2).setZero();
  LoopEnd at{InitialEnergy(), VectorXd::Zero(loop_size_)};
  at.slopes[layout.law.size + layout.weights.size + 2] = 1;

  // blocks, the last with the last sample
  const Index end = m_.size() - 1;
  Index done = 0;
  for (Index n = 0; n <= end;) {
    begins_.push_back({n, at});
    const Index last = n == end ? m_.size() : std::min(n + kBlock, end);
    ClosedLoop::Rows rows = Along(n, last, at);
    // those that are kept
    std::vector<Index> kept;
    for (auto k = static_cast<size_t>(done); k < kept_.size() && kept_[k] < last; ++k) {
      kept.push_back(kept_[k] - n);
    }
    if (std::ssize(kept) < rows.rows()) rows = rows(kept, Eigen::all).eval();
    const VectorXd left = torque_.segment(done, rows.rows()) - rows * linear;
    if (rows.rows() > 0) gram.selfadjointView<Eigen::Lower>().rankUpdate(rows.transpose());
    product += rows.transpose() * left;
    squares_ += left.squaredNorm();
    done += rows.rows();
    n = last;
  }
  gram.triangularView<Eigen::StrictlyUpper>() = gram.transpose();
  gram_ = gram(order_, order_);
  product_ = product(order_);
}

VectorXd WarmMapRows::OfEnd() const {
  VectorXd slopes = VectorXd::Zero(loop_size_ + parts_.layout.rigid.size);
  slopes.head(loop_size_) = begins_.back().at.slopes;
  return slopes(order_);
}

MatrixXd WarmMapRows::Between(Index first, Index last) const {
  MatrixXd rows(last - first, parts_.layout.size());
  if (first == last) return rows;
  // from the block that holds the first of them
  const Index begin = kept_[static_cast<size_t>(first)];
  const auto behind = std::ranges::upper_bound(begins_, begin, {}, &Begin::sample);
  LoopEnd at = (behind - 1)->at;
  for (Index n = (behind - 1)->sample, done = first; done < last;) {
    const Index end = std::min(n + kBlock, kept_[static_cast<size_t>(last - 1)] + 1);
    const ClosedLoop::Rows block = Along(n, end, at);
    for (; done < last && kept_[static_cast<size_t>(done)] < end; ++done) {
      rows.row(done - first) = block.row(kept_[static_cast<size_t>(done)] - n)(order_);
    }
    n = end;
  }
  return rows;
}

VectorXd WarmMapRows::Energy() const {
  // law and maps as one column each, whose parameters are 1
  const Layout& at = parts_.layout;
  const VectorXd weights = at.weights.Of(x_), law = at.law.Of(x_);
  VectorXd maps(m_.size());
  for (Index n = 0; n < m_.size(); n += kBlock) {
    const Index last = std::min(n + kBlock, m_.size());
    maps.segment(n, last - n) = DenseKernels(parts_.maps, points_, n, last) * weights;
  }
  MatrixXd of_loss;
  if (of_loss_.size() > 0) of_loss = of_loss_ * law + maps;
  return ClosedLoop::Along(m_, law_ * law + maps, of_loss)
      .WithJumps(parts_.jump_samples)
      .Simulate(VectorXd::Ones(1), at.ThermalAt(x_), InitialEnergy(), at.jumps.Of(x_))
      .energy;
}

}  // namespace warmjoint
