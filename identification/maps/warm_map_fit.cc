#include "identification/maps/warm_map_fit.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "identification/fit/fit_data.h"
#include "identification/linear/linear_laws.h"
#include "identification/maps/local_rows.h"
#include "identification/model/normal_equations.h"
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

/// The rows of heat, start and jumps of a fit.
Slice HeatOf(const ThermalFit& fit) {
  const Index first = fit.At(Role::gain).begin;
  return {first, fit.At(Role::gravity).begin - first};
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

/// The kernels of maps: friction that depends on the place.
class KernelBlock : public Block {
 public:
  KernelBlock(Slice at, std::vector<FrictionMap> maps, MapPoints points)
      : at_(at), maps_(std::move(maps)), points_(std::move(points)) {}
  void Fill(const VectorXd& x, ModelRows& rows) const override {
    const MatrixXd kernels = DenseKernels(maps_, points_, rows.at.first, rows.at.end());
    rows.force += kernels * at_.Of(x);
    rows.derivatives.middleCols(at_.begin, at_.size) += kernels;
  }
  bool MakesHeat() const override { return true; }

 private:
  Slice at_;
  std::vector<FrictionMap> maps_;  // shapes
  MapPoints points_;               // [N x 5]
};

/// Law, gravity and inertia, maps and heat. heat: of the fit with the latest maps, whose priors are taken over
Model ModelOf(const IdentifierInput& input, const MapTask& task, const MapBlock& block,
              const ThermalFit& heat) {
  const LogSamples& m = input.measurements;
  const LawBlocks of_law(m, LawColumns(*task.law, m.velocity), LossColumns(*task.law, m),
                         task.rigid.columns);
  Model model;
  model.samples = m.size();
  const Slice law = model.Append(Unnamed(Role::law, block.fit().of_law.size)),
              rigid = model.Append(Unnamed(Role::gravity, block.fit().of_rigid.size)),
              weights = model.Append(Unnamed(Role::weight, block.fit().of_weights.size));
  const Slice from = HeatOf(heat);
  const auto rows = heat.model->table.begin();
  model.Append(std::vector<Unknown>(rows + from.begin, rows + from.end()));
  model.blocks = {std::make_shared<FrictionBlock>(law, of_law.law, of_law.of_losses),
                  std::make_shared<KernelBlock>(weights, block.fit().maps, PointsOf(m)),
                  std::make_shared<LinearBlock>(rigid, of_law.rigid)};
  model.heat = *heat.model->heat;
  model.heat->friction = weights.end();
  model.heat->parameters = {model.At(Role::gain).begin, 2};
  model.heat->start = model.At(Role::start);
  model.heat->jumps = model.At(Role::jump);
  return model;
}

}  // namespace

WarmMapFit::WarmMapFit(const IdentifierInput& input, const MapTask& task, const MapBlock& block,
                       const WarmingBlock& warming)
    : selection_(input.selection),
      variance_(block.Squares() / static_cast<double>(input.selection.count())),
      model_(ModelOf(input, task, block, warming.fit())),
      samples_{.torque = input.measurements.torque, .keep = input.selection.keep},
      squares_(model_, samples_),
      x_(VectorXd::Zero(model_.size())) {
  const Slice weights = At(Role::weight);
  model_.groups = {{weights.Places(), block.solver().penalty() / variance_}};
  // the heat as the block has it
  const ThermalFit& heat = warming.fit();
  const Slice from = HeatOf(heat);
  x_.tail(from.size) = from.Of(heat.x);
}

bool WarmMapFit::Refine(MapBlock& block) {
  const Index linear = At(Role::weight).end();
  x_.head(linear) = block.fit().x;
  for (int i = 0; i < kMostConditions; ++i) {
    const Conditions conditions = block.solver().conditions();
    MinimiseUnder(Extended(conditions, model_.size()));
    if (!converged_) break;
    // with the energy that was found, other conditions may hold
    const VectorXd energy = ModelAt(model_, x_).Energy();
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
  problem.sums = [&](const VectorXd& x) { return squares_.At(x, variance_); };
  problem.step = [&](const MatrixXd& gram, const VectorXd& product, const VectorXd& x) {
    return StepUnder(conditions, gram, product, x);
  };
  problem.rests = kRests;
  Minimum found = Minimise(problem, x_);
  x_ = std::move(found.x);
  converged_ = found.converged && x_.allFinite();
  iterations_ += static_cast<int>(found.trace.size()) - 1;
}

void WarmMapFit::HeatInto(ThermalFit& warming) const {
  const Slice to = HeatOf(warming);
  to.In(warming.x) = x_.tail(to.size);
}

Uncertainty WarmMapFit::CovarianceOf(const MapFit& maps, const VectorXd& residual) {
  const KeptRows rows(model_, x_, samples_.keep);
  const VectorXd torque = Kept(samples_.torque, selection_);
  // with independent weights (WeightPrior), since with correlated ones the standard errors of gain and time constant would be wrong
  // by a half
  Model of_heat = model_;
  of_heat.groups.clear();
  return warmjoint::CovarianceOf(
      {.rows = [&](Index first, Index last) { return rows.Between(first, last); },
       .cofactor = Cofactor(variance_ * squares_.At(x_, variance_).gram),
       .residual = residual,
       .selection = selection_,
       .fitted = torque - residual,
       .prior = variance_ * of_heat.PriorPrecision(),
       .pull = WeightPrior{squares_.OfData(x_).gram, maps.free(), maps.weights(), maps.strength,
                           maps.unseen}});
}

}  // namespace warmjoint
