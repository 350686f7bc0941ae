#include "identification/report/report_fit.h"

#include <warmjoint/estimate.h>
#include <warmjoint/friction.h>

#include <cmath>

#include "identification/preparation/check.h"
#include "identification/report/discrete_pair.h"
#include "identification/report/end_state.h"
#include "models/foundation/robust_noise.h"
#include "models/friction/thermal.h"

namespace warmjoint {
namespace {

/// All rows that have a name; the discrete pair stands behind gain and time constant.
std::vector<EstimatedParameter> ParametersOf(const Fit& fit, const Inference& inference, double h) {
  std::vector<EstimatedParameter> all;
  const std::optional<size_t> tau = fit.RowOf(Role::heat, 1);
  for (size_t i = 0; i < fit.parameters.size(); ++i) {
    const FitParameter& row = fit.parameters[i];
    const KnownParameter& known = inference.parameters[i];
    if (!row.name.empty()) {
      all.push_back({row.name, known.value, row.unit, known.std, known.interval95});
    }
    // the pair of the sampling interval follows the time constant
    if (tau != i) continue;
    for (EstimatedParameter& one : DiscretePair(fit, inference, h)) all.push_back(std::move(one));
  }
  return all;
}

TraceEntry EntryOf(const Fit& fit, const Iterate& iterate, double h) {
  TraceEntry entry{iterate.iteration, {}, iterate.rmse};
  const std::optional<size_t> gain = fit.RowOf(Role::heat, 0), tau = fit.RowOf(Role::heat, 1);
  for (size_t i = 0; i < iterate.values.size(); ++i) {
    // what is not known yet has no place in the entry
    if (std::isnan(iterate.values[i])) continue;
    entry.parameters.emplace_back(fit.parameters[i].name, iterate.values[i]);
    // the discrete pair stands there for fits, not for the samples of a filter
    if (tau != i || iterate.energy) continue;
    const DiscreteThermal discrete = Discretise({iterate.values[*gain], iterate.values[i]}, h);
    entry.parameters.emplace_back(kDiscreteGainName, discrete.gain);
    entry.parameters.emplace_back(kPoleName, discrete.pole);
  }
  if (iterate.energy) entry.parameters.emplace_back("energy", *iterate.energy);
  return entry;
}

/// The friction with what the verdict moved.
Friction FrictionOf(const Fit& fit, const Inference& inference) {
  Friction friction = fit.friction;
  for (size_t i = 0; i < fit.parameters.size(); ++i) {
    const FitParameter& row = fit.parameters[i];
    if (row.role == Role::law) friction.parameters[row.name] = inference.parameters[i].value;
  }
  if (const auto gain = fit.RowOf(Role::heat, 0), tau = fit.RowOf(Role::heat, 1); gain && tau) {
    friction.thermal = Thermal{inference.parameters[*gain].value, inference.parameters[*tau].value};
  }
  return friction;
}

/// Covariance of the values that have an interval, to first order.
ParameterCovariance CovarianceOfValues(const Fit& fit, const Inference& inference) {
  ParameterCovariance of;
  std::vector<Eigen::Index> columns;
  std::vector<double> slopes;  // of the value by its coordinate
  Eigen::Index column = 0;
  for (size_t i = 0; i < fit.parameters.size(); ++i) {
    const FitParameter& row = fit.parameters[i];
    if (!row.estimated) continue;
    // a value of which the logarithm was fitted moves by its own size
    if (!row.name.empty() && inference.parameters[i].interval95) {
      of.parameters.push_back(row.name);
      columns.push_back(column);
      slopes.push_back(row.coordinate == Coordinate::logarithm ? row.value : 1);
    }
    ++column;
  }
  const Eigen::Map<const Eigen::VectorXd> slope(slopes.data(),
                                                static_cast<Eigen::Index>(slopes.size()));
  of.matrix =
      slope.asDiagonal() * inference.known.covariance(columns, columns).eval() * slope.asDiagonal();
  return of;
}

}  // namespace

Estimate ReportFit(const Fit& fit, const Inference& inference, const Measurements& measurements) {
  // who answers, with which status, and why
  Estimate estimate;
  estimate.identifier = fit.identifier;
  estimate.status = inference.status;
  estimate.message = inference.message;
  if (const auto& refusal = fit.refusal;
      refusal && refusal->unconverged && inference.status == refusal->status) {
    estimate.message += "; " + WhyNotConverged(measurements, *refusal->unconverged);
  }
  estimate.warnings = inference.warnings;
  estimate.diagnostics = inference.diagnostics;
  estimate.assumptions = inference.assumptions;
  estimate.choice = fit.choice;

  // how the fit came to rest
  const double h = MedianStep(measurements.time);
  for (const Iterate& iterate : fit.trace) {
    estimate.trace.push_back(EntryOf(fit, iterate, h));
  }
  if (inference.parameters.empty()) return estimate;

  // the numbers
  estimate.parameters = ParametersOf(fit, inference, h);
  estimate.metrics = ComputeMetrics(fit.torque, fit.fitted, fit.count, fit.effective_parameters);
  estimate.gravity = fit.gravity;
  if (!inference.gives_friction) return estimate;

  // and what can be used elsewhere
  estimate.friction = FrictionOf(fit, inference);
  estimate.state_end = EndState(fit, inference, *estimate.friction, measurements);
  if (inference.gives_bands) {
    estimate.bands = fit.bands;
    estimate.friction_at_speeds = fit.friction_at_speeds;
    for (FrictionAtSpeed& one : estimate.friction_at_speeds) {
      one.speed_unit = kVelocityUnit.For(measurements.joint);
      one.unit = measurements.torque_unit;
    }
  }
  // without intervals there is no covariance either
  if (inference.without_intervals.empty()) estimate.covariance = CovarianceOfValues(fit, inference);
  return estimate;
}

}  // namespace warmjoint
