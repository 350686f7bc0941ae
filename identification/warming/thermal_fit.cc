#include "identification/warming/thermal_fit.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>

#include "identification/model/least_squares.h"
#include "identification/model/normal_equations.h"
#include "identification/model/solve.h"
#include "identification/uncertainty/uncertainty.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kFirm = 1e-9;  // of the residuals' scale: the least spread of a prior

/// What is known of an unknown before the log, of noise of such a scale.
Normal PriorAt(double mean, double spread, double scale) {
  return {mean, std::max(spread, kFirm * scale)};
}

/// The unknowns of heat, E(0) and jumps, and what is known of them.
void AppendHeat(const ThermalRows& rows, Model& model) {
  model.Append(Unnamed(Role::gain, 1));
  Unknown tau;
  tau.role = Role::time_constant;
  tau.coordinate = Coordinate::logarithm;
  model.Append({tau});
  if (rows.initial.spread > 0) {
    Unknown start;
    start.role = Role::start;
    if (rows.initial.is_expected()) {
      start.prior = PriorAt(rows.initial.mean, rows.initial.spread, rows.scale);
    }
    model.Append({start});
  }
  std::vector<Unknown> jumps = Unnamed(Role::jump, std::ssize(rows.jump_samples));
  for (size_t i = 0; i < jumps.size(); ++i) {
    const double spread = rows.jump_spread[static_cast<Index>(i)];
    if (std::isfinite(spread)) jumps[i].prior = PriorAt(0, spread, rows.scale);
  }
  model.Append(jumps);
}

/// Adds the blocks of law and rigid part, the latter with its unknowns, to a table that has those of the law.
void AddBlocks(const LawBlocks& blocks, Model& model) {
  model.samples = blocks.law->rows();
  const Slice rigid = model.Append(Unnamed(Role::gravity, blocks.rigid->cols()));
  model.blocks = {
      std::make_shared<FrictionBlock>(model.At(Role::law), blocks.law, blocks.of_losses)};
  if (rigid.size > 0) {
    model.blocks.push_back(std::make_shared<LinearBlock>(rigid, blocks.rigid));
  }
}

/// Law and rigid part.
Model WithoutHeat(const LawBlocks& blocks) {
  Model model;
  model.Append(Unnamed(Role::law, blocks.law->cols()));
  AddBlocks(blocks, model);
  return model;
}

}  // namespace

LawBlocks::LawBlocks(const LogSamples& measurements, const MatrixXd& columns,
                     const MatrixXd& loss_columns, const MatrixXd& rigid_columns)
    : loop(std::make_shared<const ClosedLoop>(
          ClosedLoop::Along(measurements, columns, loss_columns))),
      law(Shared(columns)),
      of_losses(loss_columns.size() > 0 ? Shared(loss_columns) : nullptr),
      rigid(Shared(rigid_columns)) {}

LawBlocks::LawBlocks(ClosedLoop motion, const MatrixXd& columns)
    : loop(std::make_shared<const ClosedLoop>(std::move(motion))),
      law(Shared(columns)),
      rigid(Shared({})) {}

MatrixXd WarmJacobian(const LawBlocks& blocks, const VectorXd& parameters, const Thermal& thermal,
                      double initial_energy, const EnergyJumps& jumps) {
  ThermalRows rows{.blocks = blocks, .initial = InitialEnergy::estimated};
  rows.jump_samples = jumps.samples;
  rows.jump_spread = VectorXd::Constant(std::ssize(jumps.samples), kInfinity);
  const Model model = rows.MakeModel();
  VectorXd x(model.size());
  x << parameters, thermal.gain, std::log(thermal.time_constant), initial_energy, jumps.values;
  MatrixXd jacobian = ModelAt(model, x).All().derivatives;
  jacobian.col(model.At(Role::time_constant).begin) /=
      thermal.time_constant;  // from log tau to tau
  return jacobian;
}

Model ThermalRows::MakeModel() const {
  Model model;
  model.Append(Unnamed(Role::law, blocks.law->cols()));
  AppendHeat(*this, model);
  AddBlocks(blocks, model);
  model.heat = HeatLoop{.loop = blocks.loop,
                        .direction = blocks.loop->direction(),
                        .friction = blocks.law->cols(),
                        .parameters = {model.At(Role::gain).begin, 2},
                        .start = model.At(Role::start),
                        .jump_samples = jump_samples,
                        .jumps = model.At(Role::jump)};
  return model;
}

double ThermalRows::ScaleOf(const ThermalFit& fit) const {
  const double count = samples.weights.size() > 0 ? samples.weights.sum()
                                                  : static_cast<double>(samples.keep.count());
  return std::sqrt(fit.squares / count);
}

InitialGuess StartFrom(const ThermalFit& fit) {
  InitialGuess start;
  start.parameters.resize(fit.At(Role::law).size + fit.At(Role::gravity).size);
  start.parameters << fit.law(), fit.rigid();
  start.thermal = fit.thermal();
  return start;
}

ThermalFit FitThermalFriction(const ThermalRows& rows, const InitialGuess& start) {
  ThermalFit fit;
  fit.initial = rows.initial;
  const auto model = std::make_shared<const Model>(rows.MakeModel());
  const double variance = rows.scale * rows.scale;
  fit.model = model;
  fit.prior = variance * model->PriorPrecision();
  // from the scanned law and heat, without jumps, with the E(0) that is expected
  fit.x = VectorXd::Zero(model->size());
  const Slice law = fit.At(Role::law), rigid = fit.At(Role::gravity);
  law.In(fit.x) = start.parameters.head(law.size);
  fit.x[fit.At(Role::gain).begin] = start.thermal.gain;
  fit.x[fit.At(Role::time_constant).begin] = std::log(start.thermal.time_constant);
  if (fit.estimates_initial_energy()) fit.x[fit.At(Role::start).begin] = rows.initial.mean;
  rigid.In(fit.x) = start.parameters.tail(rigid.size);

  Minimum found = SolveAtNoise(*model, rows.samples, variance, fit.x);
  fit.x = std::move(found.x);
  fit.squares = found.sums.squares;
  fit.cofactor = Cofactor(found.sums.gram);
  fit.trace = std::move(found.trace);
  fit.converged = found.converged && fit.x.allFinite();

  // squares are the torque's
  for (FitPoint& iterate : fit.trace) iterate.squares *= variance;
  fit.squares *= variance;
  fit.cofactor /= variance;
  return fit;
}

ThermalFit FitWithoutHeat(const LawBlocks& blocks, const ModelSamples& samples) {
  ThermalFit fit;
  fit.model = std::make_shared<const Model>(WithoutHeat(blocks));
  LinearMinimum found = SolveLinear(*fit.model, samples);
  fit.converged = found.solved.rank == fit.model->size();
  fit.mixed = std::move(found.solved.mixed);
  fit.squares = kInfinity;
  if (!fit.converged) return fit;
  fit.squares = found.squares;
  fit.x = std::move(found.solved.solution);
  fit.cofactor = std::move(found.solved.cofactor);
  return fit;
}

EndEnergy EndOf(const ThermalFit& fit) {
  const HeatState end = ModelAt(*fit.model, fit.x).End();
  return {end.energy, end.slopes.head(fit.At(Role::gravity).begin)};
}

}  // namespace warmjoint
