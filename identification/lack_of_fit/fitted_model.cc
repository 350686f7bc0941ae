#include "identification/lack_of_fit/fitted_model.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "identification/fit/fit_along.h"
#include "identification/fit/fit_parameters.h"
#include "identification/forward/closed_loop.h"
#include "identification/forward/log_trajectory.h"
#include "identification/gravity.h"
#include "identification/linear/linear_laws.h"
#include "identification/linear/rigid_part.h"
#include "identification/warming/gaps.h"
#include "identification/warming/thermal_fit.h"
#include "models/foundation/robust_noise.h"
#include "models/friction/along_motion.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

constexpr Eigen::Index kOfEachStep = 8;  // parts of each step
// of tau's standard error; why: a bias of that size costs 0.7 % of the coverage
constexpr double kMatters = 0.25;

/// Each value for each part of its sample; empty stays empty. column: [N]; returns [N kOfEachStep].
Eigen::VectorXd Repeated(const Eigen::VectorXd& column) {
  return column.transpose().replicate(column.size() > 0 ? kOfEachStep : 1, 1).reshaped();
}

/// The same motion with kOfEachStep samples for each one, all at the speed of that sample. [N kOfEachStep]
JointTrajectory FinerTrajectory(const JointTrajectory& trajectory, double gear) {
  const Eigen::Index n = trajectory.time.size();
  // a sample lasts until the next one, the last as long as the one before it
  Eigen::VectorXd since(n * kOfEachStep);  // s, since the sample
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index step = std::min(i, n - 2);
    const double h = trajectory.time[step + 1] - trajectory.time[step];
    for (Eigen::Index k = 0; k < kOfEachStep; ++k) {
      since[i * kOfEachStep + k] = h * static_cast<double>(k) / static_cast<double>(kOfEachStep);
    }
  }

  // every column is constant over the step, except time and positions, which advance
  JointTrajectory finer;
  for (const auto column :
       {&JointTrajectory::time, &JointTrajectory::velocity, &JointTrajectory::position,
        &JointTrajectory::motor_position, &JointTrajectory::load, &JointTrajectory::ambient_rise,
        &JointTrajectory::level, &JointTrajectory::torque}) {
    finer.*column = Repeated(trajectory.*column);
  }
  const Eigen::VectorXd travelled = since.cwiseProduct(finer.velocity);
  finer.time += since;
  if (finer.position.size() > 0) finer.position += travelled;
  if (finer.motor_position.size() > 0) finer.motor_position += gear * travelled;
  for (const Eigen::Index start : trajectory.starts) finer.starts.push_back(start * kOfEachStep);
  return finer;
}

/// The torque that maps add to law and warming. [N]
Eigen::VectorXd MapForce(const Law& law, const std::vector<double>& values, const LogSamples& m,
                         const Prediction& prediction) {
  Eigen::VectorXd force = prediction.force;
  for (Eigen::Index i = 0; i < force.size(); ++i) {
    const double v = m.velocity[i];
    force[i] -= WarmForce(v, law.force(v, values.data()), prediction.energy[i]);
  }
  return force;
}

void TakeOff(const GravityModel& gravity, const Eigen::VectorXd& position, FittedModel& model) {
  model.torque -= gravity.Torque(position);
  // samples at places where gravity is not known take no part
  for (Eigen::Index i = 0; i < position.size(); ++i) {
    model.selection.keep[i] = model.selection.keep[i] && gravity.Covers(position[i]);
  }
}

/// Rows of the fit's table in the order of the derivatives.
std::vector<size_t> RowsOf(const Fit& fit, std::initializer_list<Role> roles) {
  std::vector<size_t> rows;
  for (const Role role : roles) {
    for (size_t i = 0; i < fit.parameters.size(); ++i) {
      const Unknown& parameter = fit.parameters[i];
      if (parameter.role == role && !parameter.name.empty()) rows.push_back(i);
    }
  }
  return rows;
}

/// Where E of a fit jumps along its log: at gaps, by the losses that were not logged, and at further starts, by the heat
/// from before. A start that was not fitted is an assumption.
struct Jumps {
  std::vector<LogGap> at;        // [J]
  Eigen::VectorXd values;        // [J] N.m or N, 0 where none was fitted
  std::vector<bool> is_assumed;  // [J]
};

Jumps JumpsOf(const Fit& fit, const LogSamples& m) {
  Jumps jumps{Merged(FindGaps(m), FurtherStarts(m)), {}, {}};
  jumps.values = Eigen::VectorXd::Zero(std::ssize(jumps.at));
  const std::vector<EnergyJump> fitted = fit.Start().jumps;
  for (const LogGap& at : jumps.at) {
    const auto found = std::ranges::find(fitted, at.behind, &EnergyJump::sample);
    const auto i = std::ssize(jumps.is_assumed);
    if (found != fitted.end()) jumps.values[i] = found->change;
    jumps.is_assumed.push_back(IsStart(at) && found == fitted.end());
  }
  return jumps;
}

/// Whether the step h of a log matters to its warming: (22) holds W over a step, in which E and
/// with it W changes, so that tau comes out too large by h |k v|/2 (to first order in h/tau). It matters where
/// that is more than a quarter of the standard error of tau. velocity: [N], rad/s or m/s;
/// step: h, s.
bool StepMatters(const Fit& fit, const Inference& inference, const Eigen::VectorXd& velocity,
                 double step) {
  if (!fit.model.friction.thermal) return false;
  const auto tau = fit.RowOf(Role::time_constant);
  if (!tau || !inference.parameters[*tau].std) return false;
  // by how much tau comes out too large, h |k v|/2
  const double gain = fit.model.friction.thermal->gain;
  const double power = std::abs(gain) * velocity.cwiseAbs().mean();
  return 0.5 * step * power > kMatters * *inference.parameters[*tau].std;
}

/// Adds what follows from an estimated warming, with which the law's parameters act through the losses too. Returns the
/// derivatives by the jumps that are no assumption, [N x J].
Eigen::MatrixXd AddWarming(const Fit& fit, const Inference& inference, const LogSamples& m,
                           FittedModel& model) {
  std::vector<double> values = LawValues(fit.model.friction);
  if (fit.RowOf(Role::load)) values.push_back(fit.model.friction.load_gain);
  const Thermal& thermal = *fit.model.friction.thermal;
  model.thermal = thermal;

  // where the log has mean velocities, these make the losses
  Eigen::MatrixXd of_loss;
  if (m.loss_velocity) {
    of_loss = NominalDerivatives(fit, *m.loss_velocity, m.load);
  }
  const Jumps jumps = JumpsOf(fit, m);
  const LawBlocks blocks(m, model.derivatives, of_loss, {});
  model.loop = blocks.loop;
  const auto d = static_cast<Eigen::Index>(values.size());
  const Eigen::Map<const Eigen::VectorXd> parameters(values.data(), d);
  const Eigen::MatrixXd all =
      WarmJacobian(blocks, parameters, thermal, fit.start.energy, {Behind(jumps.at), jumps.values});

  // law, heat and, where it was estimated, the first start; where it was not, it is an assumption, too
  const bool starts = !fit.Values(Role::start).empty();
  model.derivatives = all.leftCols(starts ? d + 3 : d + 2);
  std::vector<LogGap> known;
  std::vector<Eigen::Index> by_known, by_assumed;  // columns
  if (!starts) by_assumed.push_back(d + 2);
  for (size_t i = 0; i < jumps.at.size(); ++i) {
    const bool is_assumed = jumps.is_assumed[i];
    (is_assumed ? by_assumed : by_known).push_back(d + 3 + static_cast<Eigen::Index>(i));
    if (!is_assumed) known.push_back(jumps.at[i]);
  }
  model.by_initial_energy = all(Eigen::all, by_assumed);

  // how large the jumps may be, and the force that losses held over each step leave out
  model.jump_spread = JumpSpread(known, model.energy.cwiseAbs().maxCoeff(), thermal.time_constant);
  if (StepMatters(fit, inference, m.velocity, model.step)) {
    model.held_loss = ForceOfHeldLoss(fit.model.friction, m, fit.Start());
  }
  return all(Eigen::all, by_known);
}

/// Whether a weight may act on the joint that the fit has no part for. A map over the position holds it.
bool MayCarryWeight(const Fit& fit, const FittedModel& model, const LogSamples& m) {
  const bool mapped = std::ranges::find(model.mapped, MapQuantity::position) != model.mapped.end();
  return m.joint == JointKind::rotary && !fit.model.gravity && !mapped && !m.position_integrated &&
         m.position.allFinite();
}

/// The columns of the fit's gravity, as a sine, and of its inertia. [N x r]
Eigen::MatrixXd RigidColumns(const Fit& fit, const LogSamples& m) {
  Eigen::MatrixXd columns(m.size(), 0);
  if (fit.model.gravity && fit.model.gravity->kind == GravityKind::sincos) {
    columns = GravityColumns(GravityKind::sincos, {}, m.position);
  }
  return fit.model.inertia && m.acceleration ? ConcatColumns(columns, *m.acceleration) : columns;
}

/// The Jacobian's columns of the estimated rows of the table with a role. [N x m]
Eigen::MatrixXd ByRole(const Fit& fit, Role role) {
  std::vector<Eigen::Index> columns;
  Eigen::Index column = 0;
  for (const Unknown& row : fit.parameters) {
    if (row.estimated && row.role == role) columns.push_back(column);
    column += row.estimated;
  }
  return fit.rows.jacobian()(Eigen::all, columns);
}

}  // namespace

Eigen::MatrixXd NominalDerivatives(const Law& law, const std::vector<double>& values,
                                   const Eigen::VectorXd& velocity) {
  if (IsLinear(law)) return LawColumns(law, velocity);
  Eigen::MatrixXd derivatives(velocity.size(), static_cast<Eigen::Index>(values.size()));
  for (size_t i = 0; i < values.size(); ++i) {
    const double step = 1e-5 * (std::abs(values[i]) + 1e-3);
    std::vector<double> above = values, below = values;
    above[i] += step;
    below[i] -= step;
    for (Eigen::Index n = 0; n < velocity.size(); ++n) {
      derivatives(n, static_cast<Eigen::Index>(i)) =
          (law.force(velocity[n], above.data()) - law.force(velocity[n], below.data())) /
          (2 * step);
    }
  }
  return derivatives;
}

Eigen::MatrixXd NominalDerivatives(const Fit& fit, const Eigen::VectorXd& velocity,
                                   const std::optional<Eigen::VectorXd>& load) {
  Eigen::MatrixXd derivatives =
      NominalDerivatives(*FindLaw(fit.model.friction.law), LawValues(fit.model.friction), velocity);
  const PartFit grows = fit.RowOf(Role::load) ? PartFit::estimated : PartFit::none;
  return WithLoad(std::move(derivatives), grows, velocity, load);
}

std::optional<FittedModel> EvaluateModel(const Fit& fit, const Inference& inference,
                                         const LogSamples& m, const Selection& selection) {
  if (fit.refusal) return std::nullopt;
  const Law& law = *FindLaw(fit.model.friction.law);

  // the residual of the fit
  FittedModel model;
  model.selection = selection;
  if (m.size() > 1) model.step = MedianStep(m.time);
  model.has_bristle = law.pre_sliding == PreSliding::bristle;
  model.torque = m.torque;
  if (fit.model.gravity) TakeOff(*fit.model.gravity, m.position, model);
  if (fit.model.inertia) model.torque -= *fit.model.inertia * *m.acceleration;
  if (fit.rows.rest.size() > 0) model.torque -= fit.rows.rest;
  const Prediction prediction = FrictionAlong(fit, m);
  model.residual = model.torque - prediction.force;
  model.energy = prediction.energy;
  if (!fit.model.friction.maps.empty())
    model.maps = MapForce(law, LawValues(fit.model.friction), m, prediction);
  for (const FrictionMap& map : fit.model.friction.maps) {
    for (const MapAxis& axis : map.axes) model.mapped.push_back(axis.quantity);
  }

  // a weight that the fit leaves out, or that may differ between recordings
  model.weight = MayCarryWeight(fit, model, m) ? GravityColumns(GravityKind::sincos, {}, m.position)
                                               : Eigen::MatrixXd(m.size(), 0);
  model.rigid = RigidColumns(fit, m);

  // the derivatives of the model by the fit's parameters
  model.rows = RowsOf(
      fit, {Role::law, Role::load, Role::gain, Role::time_constant, Role::start, Role::gravity});
  if (fit.model.inertia) model.rows.push_back(*fit.RowOf(Role::inertia));
  model.cold = NominalDerivatives(fit, m.velocity, m.load);
  model.derivatives = model.cold;
  const bool knows_warming = fit.model.friction.thermal && fit.RowOf(Role::gain);
  Eigen::MatrixXd by_jumps(m.size(), 0);
  if (knows_warming) by_jumps = AddWarming(fit, inference, m, model);
  model.of_friction = model.derivatives.cols();
  // gravity's few values join the parameters. The many of `paired` do not: they take up all that depends on position
  // in the same way in both directions, over which the other features average out
  if (fit.model.gravity && fit.model.gravity->kind != GravityKind::paired) {
    // where friction grows with the load, gravity acts through the friction, too; the fit's own Jacobian includes that
    const bool by_fit = fit.RowOf(Role::load) && fit.rows.jacobian;
    model.derivatives = ConcatColumns(
        model.derivatives,
        by_fit ? ByRole(fit, Role::gravity)
               : GravityColumns(fit.model.gravity->kind, fit.model.gravity->knots, m.position));
  }
  if (fit.model.inertia) model.derivatives = ConcatColumns(model.derivatives, *m.acceleration);
  if (fit.RowOf(Role::delay)) by_jumps = ConcatColumns(by_jumps, ByRole(fit, Role::delay));
  if (by_jumps.cols() > 0) model.derivatives = ConcatColumns(model.derivatives, by_jumps);
  return model;
}

Eigen::VectorXd ForceOfHeldLoss(const Friction& friction, const LogSamples& measurements,
                                const ThermalStart& start) {
  const AlongMotion model(friction);
  const JointTrajectory trajectory = TrajectoryOf(measurements);
  // E jumps at the same moments of the finer trajectory
  ThermalStart finer_start = start;
  for (EnergyJump& jump : finer_start.jumps) jump.sample *= kOfEachStep;
  const Eigen::VectorXd fine =
      model.Predict(FinerTrajectory(trajectory, measurements.gear), finer_start).force;
  const Eigen::VectorXd held = model.Predict(trajectory, start).force;

  // steps of an eighth leave an eighth of the error, so that the whole error is 8/7 of the difference
  Eigen::VectorXd difference(held.size());
  for (Eigen::Index n = 0; n < held.size(); ++n) difference[n] = fine[n * kOfEachStep] - held[n];
  return difference * static_cast<double>(kOfEachStep) / static_cast<double>(kOfEachStep - 1);
}

}  // namespace warmjoint
