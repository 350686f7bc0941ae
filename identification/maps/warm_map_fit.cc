#include "identification/maps/warm_map_fit.h"

#include <Eigen/Cholesky>
#include <utility>

#include "identification/uncertainty/uncertainty.h"
#include "identification/uncertainty/weight_prior.h"
#include "identification/warming/gaps.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A fit ends at a step that promises less than this, since it changes no unknown by more than 0.001 of its deviation, and the
/// next step by far less, while each costs a pass over the rows.
constexpr double kRests = 1e-6;
/// The most rounds in which the bounds of the law that hold are determined again at the solution.
constexpr int kMostConditions = 3;

Layout JoinedLayout(const Layout& maps, const Layout& heat) {
  return Layout::InOrder({{&Layout::law, maps.law.size},
                          {&Layout::rigid, maps.rigid.size},
                          {&Layout::weights, maps.weights.size},
                          {&Layout::heat, heat.heat.size},
                          {&Layout::start, heat.start.size},
                          {&Layout::jumps, heat.jumps.size}});
}

/// Conditions on law and weights as such on all unknowns. p: their number
Conditions Extended(const Conditions& conditions, Index p) {
  Conditions all{MatrixXd::Zero(conditions.rows.rows(), p), conditions.values};
  all.rows.leftCols(conditions.rows.cols()) = conditions.rows;
  return all;
}

/// 1 over the norm of each column: the gain's are far from the others'.
VectorXd ScaleOf(const MatrixXd& gram) { return gram.diagonal().cwiseSqrt().cwiseInverse(); }

/// The step of gram step = product from x, for which x + step keeps the conditions.
VectorXd StepUnder(const Conditions& conditions, const MatrixXd& gram, const VectorXd& product,
                   const VectorXd& x) {
  const VectorXd scale = ScaleOf(gram);
  const Conditioned solver(scale.asDiagonal() * gram * scale.asDiagonal(),
                           {conditions.rows * scale.asDiagonal(), conditions.values});
  if (!solver.works()) return VectorXd::Zero(x.size());
  return scale.cwiseProduct(solver.Solve(scale.cwiseProduct(gram * x + product))) - x;
}

}  // namespace

WarmMapFit::WarmMapFit(const IdentifierInput& input, const MapTask& task, const MapBlock& block,
                       const WarmingBlock& warming)
    : selection_(input.selection),
      penalty_(block.solver().penalty()),
      variance_(block.Squares() / static_cast<double>(input.selection.count())),
      rows_(input, {.law = *task.law,
                    .maps = block.fit().maps,
                    .rigid = task.rigid.columns,
                    .jump_samples = Behind(warming.gaps()),
                    .layout = JoinedLayout(block.fit().layout, warming.fit().layout)}) {
  // the heat as the block has it, and what is known of it beforehand
  const ThermalFit& heat = warming.fit();
  prior_ = mean_ = x_ = VectorXd::Zero(layout().size());
  const Index first = heat.layout.heat.begin, count = heat.layout.rigid.begin - first;
  prior_.tail(count) = heat.prior.segment(first, count);
  if (layout().start.size > 0) mean_[layout().energy()] = heat.initial.mean;
  x_.tail(count) = heat.x.segment(first, count);
}

bool WarmMapFit::Refine(MapBlock& block) {
  const Index linear = layout().weights.end();
  x_.head(linear) = block.fit().x;
  for (int i = 0; i < kMostConditions; ++i) {
    const Conditions conditions = block.solver().conditions();
    MinimiseUnder(Extended(conditions, layout().size()));
    if (!converged_) break;
    // with the energy that was found, other conditions may hold
    const VectorXd energy = rows_.Energy();
    if (!block.FitGiven(energy)) return false;
    const bool hold = block.solver().conditions() == conditions;
    if (hold || i + 1 == kMostConditions) {
      block.Take(x_.head(linear), energy);
      return true;
    }
    x_.head(linear) = block.fit().x;
  }
  return true;
}

void WarmMapFit::MinimiseUnder(const Conditions& conditions) {
  SquaresProblem problem;
  problem.sums = [&](const VectorXd& x) { return At(x); };
  problem.step = [&](const MatrixXd& gram, const VectorXd& product, const VectorXd& x) {
    return StepUnder(conditions, gram, product, x);
  };
  problem.rests = kRests;
  Minimum found = Minimise(problem, x_);
  x_ = std::move(found.x);
  rows_.MoveTo(x_);
  converged_ = found.converged && x_.allFinite();
  iterations_ += static_cast<int>(found.trace.size()) - 1;
}

MatrixXd WarmMapFit::Penalised() const {
  MatrixXd gram = rows_.gram();
  const Slice& at = layout().weights;
  gram.block(at.begin, at.begin, at.size, at.size) += penalty_;
  gram.diagonal() += prior_;
  return gram;
}

RowSums WarmMapFit::At(const VectorXd& x) {
  rows_.MoveTo(x);
  const VectorXd weights = layout().weights.Of(x), pulled = penalty_ * weights;
  const VectorXd off = x - mean_;
  RowSums sums{Penalised(), rows_.product() - prior_.cwiseProduct(off),
               rows_.squares() + weights.dot(pulled) + prior_.dot(off.cwiseAbs2())};
  layout().weights.In(sums.product) -= pulled;
  sums.gram /= variance_;
  sums.product /= variance_;
  sums.squares /= variance_;
  return sums;
}

void WarmMapFit::HeatInto(ThermalFit& warming) const {
  const Index first = warming.layout.heat.begin, count = warming.layout.rigid.begin - first;
  warming.x.segment(first, count) = x_.tail(count);
}

Uncertainty WarmMapFit::CovarianceOf(const MapFit& maps, const VectorXd& residual) const {
  // with independent weights, since with correlated ones the standard errors of gain and time constant would be wrong by a half
  return warmjoint::CovarianceOf(
      {.rows = [&](Index first, Index last) { return rows_.Between(first, last); },
       .cofactor = Cofactor(Penalised()),
       .residual = residual,
       .selection = selection_,
       .fitted = rows_.torque() - residual,
       .prior = prior_,
       .pull = WeightPrior{rows_.gram(), maps.free(), maps.weights(), maps.strength, maps.unseen}});
}

}  // namespace warmjoint
