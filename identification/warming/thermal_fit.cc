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

/// Law and rigid part in a layout.
Model WithoutHeat(const LawBlocks& blocks, const Layout& at) {
  Model model;
  model.samples = blocks.law->rows();
  for (const auto& [part, role] : {std::pair(at.law, Role::law),
                                   {at.heat, Role::heat},
                                   {at.start, Role::start},
                                   {at.jumps, Role::jump},
                                   {at.rigid, Role::gravity}}) {
    Unknown unknown;
    unknown.role = role;
    model.Append(std::vector<Unknown>(static_cast<size_t>(part.size), unknown));
  }
  model.blocks = {std::make_shared<FrictionBlock>(at.law, blocks.law, blocks.of_losses)};
  if (at.rigid.size > 0) {
    model.blocks.push_back(std::make_shared<LinearBlock>(at.rigid, blocks.rigid));
  }
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
  jacobian.col(rows.layout().log_time_constant()) /= thermal.time_constant;  // from log tau to tau
  return jacobian;
}

Layout ThermalRows::layout() const {
  return Layout::InOrder({{&Layout::law, blocks.law->cols()},
                          {&Layout::heat, 2},
                          {&Layout::start, initial.spread > 0 ? 1 : 0},
                          {&Layout::jumps, std::ssize(jump_samples)},
                          {&Layout::rigid, blocks.rigid->cols()}});
}

Model ThermalRows::MakeModel() const {
  const Layout at = layout();
  Model model = WithoutHeat(blocks, at);
  model.heat = HeatLoop{.loop = blocks.loop,
                        .direction = blocks.loop->direction(),
                        .friction = at.law.size,
                        .parameters = at.heat,
                        .start = at.start,
                        .jump_samples = jump_samples,
                        .jumps = at.jumps};
  const auto row = [&](Index i) -> Unknown& { return model.table[static_cast<size_t>(i)]; };
  row(at.log_time_constant()).coordinate = Coordinate::logarithm;
  // what is known before the log
  const auto prior = [&](double mean, double spread) {
    return Normal{mean, std::max(spread, kFirm * scale)};
  };
  for (Index i = 0; i < at.jumps.size; ++i) {
    if (std::isfinite(jump_spread[i])) row(at.jumps.begin + i).prior = prior(0, jump_spread[i]);
  }
  if (at.start.size > 0 && initial.is_expected()) {
    row(at.energy()).prior = prior(initial.mean, initial.spread);
  }
  return model;
}

double ThermalRows::ScaleOf(const ThermalFit& fit) const {
  const double count = samples.weights.size() > 0 ? samples.weights.sum()
                                                  : static_cast<double>(samples.keep.count());
  return std::sqrt(fit.squares / count);
}

InitialGuess StartFrom(const ThermalFit& fit) {
  InitialGuess start;
  start.parameters.resize(fit.layout.law.size + fit.layout.rigid.size);
  start.parameters << fit.law(), fit.rigid();
  start.thermal = fit.thermal();
  return start;
}

ThermalFit FitThermalFriction(const ThermalRows& rows, const InitialGuess& start) {
  ThermalFit fit;
  fit.layout = rows.layout();
  fit.initial = rows.initial;
  const auto model = std::make_shared<const Model>(rows.MakeModel());
  const double variance = rows.scale * rows.scale;
  fit.model = model;
  fit.prior = variance * model->PriorPrecision();
  // from the scanned law and heat, without jumps, with the E(0) that is expected
  const Layout& at = fit.layout;
  fit.x = VectorXd::Zero(at.size());
  at.law.In(fit.x) = start.parameters.head(at.law.size);
  fit.x[at.gain()] = start.thermal.gain;
  fit.x[at.log_time_constant()] = std::log(start.thermal.time_constant);
  if (at.start.size > 0) fit.x[at.energy()] = rows.initial.mean;
  at.rigid.In(fit.x) = start.parameters.tail(at.rigid.size);

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
  fit.layout =
      Layout::InOrder({{&Layout::law, blocks.law->cols()}, {&Layout::rigid, blocks.rigid->cols()}});
  fit.model = std::make_shared<const Model>(WithoutHeat(blocks, fit.layout));
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
  return {end.energy, end.slopes.head(fit.layout.rigid.begin)};
}

}  // namespace warmjoint
