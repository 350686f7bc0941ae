#include "identification/report/report_fit.h"

#include <warmjoint/estimate.h>
#include <warmjoint/friction.h>
#include <warmjoint/friction_model.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "identification/fit/fit.h"
#include "identification/fit/fit_parameters.h"
#include "identification/forward/log_trajectory.h"
#include "identification/inference/apply.h"
#include "identification/inference/inference.h"
#include "identification/linear/linear_laws.h"
#include "identification/preparation/check.h"
#include "identification/sentences/fit.h"
#include "identification/sentences/friction.h"
#include "identification/uncertainty/tails.h"
#include "models/foundation/robust_noise.h"
#include "models/friction/sign.h"
#include "models/friction/thermal.h"

namespace warmjoint {
namespace {

/// E of both stages at the end of a log, along its motion. N.m or N
Eigen::Vector2d EndAlong(const LogSamples& m, const Friction& friction, const ThermalStart& start) {
  const FrictionState end = PredictFriction(friction, m, start).end;
  return {end.energy, end.second_energy};
}

/// Errors of figures.
struct FigureErrors {
  Eigen::MatrixXd covariance;           // [q x q] by noise
  std::vector<FigureChange> by_causes;  // [q]
  bool has_intervals = true;            // whether every parameter that matters has an interval
};

/// An estimated row of the table: its place there, among the estimated ones, and among those of its role.
struct EstimatedRow {
  size_t row = 0;
  Eigen::Index column = 0;
  size_t jump = 0;  // of a row that is one
};

/// The rows that friction and start depend on. They do not depend on gravity, inertia and a lag of the torque.
std::vector<EstimatedRow> RowsThatMatter(const Fit& fit) {
  std::vector<EstimatedRow> rows;
  EstimatedRow at;
  for (; at.row < fit.parameters.size(); ++at.row) {
    const Unknown& row = fit.parameters[at.row];
    if (!row.estimated) continue;
    const bool matters = IsNominal(row.role) || IsHeat(row.role) || row.role == Role::start ||
                         row.role == Role::jump;
    if (matters && !row.name.empty()) rows.push_back(at);
    if (row.role == Role::jump) ++at.jump;
    ++at.column;
  }
  return rows;
}

/// Friction and start with one row of the table at another value.
void Set(const Unknown& row, size_t jump, double value, Friction& friction, ThermalStart& start) {
  if (double* const place = row.PlaceIn(friction)) *place = value;
  if (row.role == Role::start) start.energy = value;
  if (row.role == Role::jump) start.jumps[jump].change = value;
}

/// Slopes of EndAlong over the parameters of law, heat, start and jumps, each in its coordinate, by central
/// differences of a standard deviation; 0 over all others. [2 x p]
Eigen::MatrixXd SlopesByDifferences(const Fit& fit, const Inference& inference,
                                    const Friction& friction, const LogSamples& m) {
  const Uncertainty& uncertainty = inference.uncertainty;
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(2, uncertainty.covariance.rows());
  for (const EstimatedRow& at : RowsThatMatter(fit)) {
    const Unknown& row = fit.parameters[at.row];
    const double value = inference.parameters[at.row].value;
    const double deviation = uncertainty.Deviation(at.column);

    // a step of one standard deviation of the value; one that could turn a sign gives no slope
    const double step = row.ValueByCoordinate(value) * deviation;
    const bool keeps_its_sign = IsNominal(row.role) || IsHeat(row.role);
    if (!(step > 0) || (keeps_its_sign && !(step < std::abs(value)))) continue;

    // E on both sides
    Friction above = friction, below = friction;
    ThermalStart above_start = fit.Start(), below_start = fit.Start();
    Set(row, at.jump, value + step, above, above_start);
    Set(row, at.jump, value - step, below, below_start);
    slopes.col(at.column) =
        (EndAlong(m, above, above_start) - EndAlong(m, below, below_start)) / (2 * deviation);
  }
  return slopes;
}

/// The errors of figures from the covariance of the parameters, to first order. slopes: [q x p], over the coordinates.
FigureErrors ErrorsBySlopes(const Fit& fit, const Inference& inference,
                            const Eigen::MatrixXd& slopes) {
  FigureErrors errors{slopes * inference.uncertainty.covariance * slopes.transpose(), {}, true};
  Eigen::MatrixXd by_value = Eigen::MatrixXd::Zero(slopes.rows(), std::ssize(inference.parameters));
  for (const EstimatedRow& at : RowsThatMatter(fit)) {
    const ParameterInterval& estimated = inference.parameters[at.row];
    errors.has_intervals = errors.has_intervals && estimated.interval95;
    // causes change the value, not its coordinate
    by_value.col(static_cast<Eigen::Index>(at.row)) =
        slopes.col(at.column) / fit.parameters[at.row].ValueByCoordinate(estimated.value);
  }
  for (Eigen::Index i = 0; i < by_value.rows(); ++i) {
    errors.by_causes.push_back(ChangeOf(inference.causes, by_value.row(i), About::parameters));
  }
  return errors;
}

/// Place of a row of the table among the estimated ones.
Eigen::Index ColumnOf(const Fit& fit, size_t row) {
  Eigen::Index column = 0;
  for (size_t i = 0; i < row; ++i) column += fit.parameters[i].estimated;
  return column;
}

/// Covariance of (k, ln tau).
Eigen::Matrix2d HeatCovariance(const Fit& fit, const Inference& inference, size_t gain,
                               size_t tau) {
  const std::array<Eigen::Index, 2> rows{ColumnOf(fit, gain), ColumnOf(fit, tau)};
  return inference.uncertainty.covariance(rows, rows);
}

/// Changes a figure, and its interval where it has one.
void Move(const FigureChange& change, EstimatedParameter& figure) {
  if (figure.interval95) {
    Move(change, figure.value, *figure.interval95);
  } else {
    figure.value += change.shift;
  }
}

/// thermal_gain_discrete (ke) and thermal_pole (te) for a sampling interval h (s). Their standard
/// deviations follow those of (k, ln tau) to first order; the interval of te is that of ln tau, so
/// that it stays between 0 and 1. Causes change both by their derivatives by k and tau. There are no
/// intervals where k and tau have none.
std::vector<EstimatedParameter> DiscretePair(const Fit& fit, const Inference& inference, double h) {
  // k and tau as they were fitted, and the discrete pair of one sampling interval
  const size_t gain_row = *fit.RowOf(Role::gain), tau_row = *fit.RowOf(Role::time_constant);
  const Thermal fitted{fit.parameters[gain_row].value, fit.parameters[tau_row].value};
  const ParameterInterval& known_gain = inference.parameters[gain_row];
  const ParameterInterval& known_tau = inference.parameters[tau_row];
  const DiscreteThermal discrete = Discretise(fitted, h);
  EstimatedParameter gain{
      std::string(kDiscreteGainName), discrete.gain, fit.parameters[gain_row].unit, {}, {}};
  EstimatedParameter pole{std::string(kPoleName), discrete.pole, "1", {}, {}};

  // to first order; dte/dln tau = te h/tau
  const double by_pole = discrete.pole * h / fitted.time_constant;
  const double cooling = -std::expm1(-h / fitted.time_constant);
  if (known_gain.interval95 && known_tau.interval95) {
    const Eigen::Matrix2d covariance = HeatCovariance(fit, inference, gain_row, tau_row);
    const double quantile =
        StudentQuantile(inference.uncertainty.degrees_of_freedom, kIntervalLevel);
    // ke = k (1 - te) by k and by ln tau
    const Eigen::Vector2d by_gain(cooling, -fitted.gain * by_pole);
    gain.std = std::sqrt(by_gain.dot(covariance * by_gain));
    gain.interval95 = {{gain.value - quantile * *gain.std, gain.value + quantile * *gain.std}};
    pole.std = by_pole * std::sqrt(covariance(1, 1));
    // the ends of ln tau, so that the interval of te stays between 0 and 1
    const double factor = std::exp(quantile * std::sqrt(covariance(1, 1)));
    pole.interval95 = {{std::exp(-h * factor / fitted.time_constant),
                        std::exp(-h / (fitted.time_constant * factor))}};
  }

  // what the causes change: to first order the intervals, exactly the values
  const Thermal now{known_gain.value, known_tau.value};
  const DiscreteThermal moved = Discretise(now, h);
  const double pole_by_tau = moved.pole * h / std::pow(now.time_constant, 2);
  const auto rows = std::ssize(inference.parameters);
  const Eigen::VectorXd of_gain = Eigen::VectorXd::Unit(rows, static_cast<Eigen::Index>(gain_row)),
                        of_tau = Eigen::VectorXd::Unit(rows, static_cast<Eigen::Index>(tau_row));
  const auto change = [&](const Eigen::VectorXd& derivatives, double shift) {
    FigureChange one = ChangeOf(inference.causes, derivatives, About::parameters);
    one.shift = shift;
    return one;
  };
  Move(change(pole_by_tau * of_tau, moved.pole - discrete.pole), pole);
  Move(change((1 - moved.pole) * of_gain - now.gain * pole_by_tau * of_tau,
              moved.gain - discrete.gain),
       gain);
  return {gain, pole};
}

/// All rows that have a name; the discrete pair follows gain and time constant.
std::vector<EstimatedParameter> ParametersOf(const Fit& fit, const Inference& inference, double h) {
  std::vector<EstimatedParameter> all;
  const std::optional<size_t> tau = fit.RowOf(Role::time_constant);
  for (size_t i = 0; i < fit.parameters.size(); ++i) {
    const Unknown& row = fit.parameters[i];
    const ParameterInterval& estimated = inference.parameters[i];
    if (!row.name.empty()) {
      all.push_back({row.name, estimated.value, row.unit, estimated.std, estimated.interval95});
    }
    // the pair of the sampling interval follows the time constant
    if (tau != i) continue;
    for (EstimatedParameter& one : DiscretePair(fit, inference, h)) all.push_back(std::move(one));
  }
  return all;
}

TraceEntry EntryOf(const Fit& fit, const Iterate& iterate, double h) {
  TraceEntry entry{iterate.iteration, {}, iterate.rmse};
  const std::optional<size_t> gain = fit.RowOf(Role::gain), tau = fit.RowOf(Role::time_constant);
  for (size_t i = 0; i < iterate.values.size(); ++i) {
    // values that are not known yet are left out of the entry
    if (std::isnan(iterate.values[i])) continue;
    entry.parameters.emplace_back(fit.parameters[i].name, iterate.values[i]);
    // the discrete pair is listed for fits, not for the samples of a filter
    if (tau != i || iterate.energy) continue;
    const DiscreteThermal discrete = Discretise({iterate.values[*gain], iterate.values[i]}, h);
    entry.parameters.emplace_back(kDiscreteGainName, discrete.gain);
    entry.parameters.emplace_back(kPoleName, discrete.pole);
  }
  if (iterate.energy) entry.parameters.emplace_back("energy", *iterate.energy);
  return entry;
}

/// Covariance of the values that have an interval, to first order.
ParameterCovariance CovarianceOfValues(const Fit& fit, const Inference& inference) {
  ParameterCovariance of;
  std::vector<Eigen::Index> columns;
  std::vector<double> slopes;  // of the value by its coordinate
  for (size_t i = 0; i < fit.parameters.size(); ++i) {
    const Unknown& row = fit.parameters[i];
    if (!row.estimated || row.name.empty() || !inference.parameters[i].interval95) continue;
    of.parameters.push_back(row.name);
    columns.push_back(ColumnOf(fit, i));
    slopes.push_back(row.ValueByCoordinate(row.value));
  }
  const Eigen::Map<const Eigen::VectorXd> slope(slopes.data(), std::ssize(slopes));
  of.matrix = slope.asDiagonal() * inference.uncertainty.covariance(columns, columns).eval() *
              slope.asDiagonal();
  return of;
}

/// The parts of the half widths of all intervals.
std::vector<HalfWidthPart> HalfWidths(const Fit& fit, const Inference& inference) {
  std::vector<HalfWidthPart> all;
  const auto add = [&](const std::string& name, const std::vector<WidthPart>& parts) {
    if (name.empty()) return;
    for (const WidthPart& part : parts) {
      all.push_back({name, std::string(NameOf(part.by)), part.half_width});
    }
  };
  for (const SpeedFigure& one : inference.at_speeds) add(NameOfFriction(one.at), one.parts);
  for (size_t i = 0; i < fit.parameters.size(); ++i) {
    if (!inference.parameters[i].interval95) continue;
    add(fit.parameters[i].name, inference.parameters[i].parts);
  }
  return all;
}

/// Changes a figure by the causes' changes of the law's parameters. by_law: [d] its derivatives by these, which come first in
/// the table
void Carry(const Inference& inference, const Eigen::RowVectorXd& by_law, double& value,
           std::array<double, 2>& interval) {
  Eigen::VectorXd derivatives = Eigen::VectorXd::Zero(std::ssize(inference.parameters));
  derivatives.head(by_law.size()) = by_law;
  Move(ChangeOf(inference.causes, derivatives, About::friction), value, interval);
}

/// Bands along maps, by the law that is reported.
std::vector<MapBand> BandsOf(const Fit& fit, const Inference& inference) {
  std::vector<MapBand> bands = fit.figures.bands;
  for (size_t b = 0; b < bands.size(); ++b) {
    MapBand& band = bands[b];
    for (size_t g = 0; g < band.value.size(); ++g) {
      Carry(inference, fit.figures.bands_by_law[b].row(static_cast<Eigen::Index>(g)), band.value[g],
            band.interval95[g]);
    }
  }
  return bands;
}

}  // namespace

std::vector<EstimatedParameter> EndState(const Fit& fit, const Inference& inference,
                                         const Friction& friction, const LogSamples& m) {
  if (!friction.thermal) return {};

  // E of both stages at the end of the log: by the fit's own recursion, or along the motion
  Eigen::Vector2d end;
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(2, inference.uncertainty.covariance.rows());
  if (fit.figures.end_energy) {
    const EndEnergy own = fit.figures.end_energy();
    end = {own.value, 0};
    slopes.row(0).head(own.slopes.size()) = own.slopes;
  } else {
    slopes = SlopesByDifferences(fit, inference, friction, m);
  }
  // a verdict may have changed parameters
  const bool is_as_fitted = std::ranges::equal(inference.parameters, fit.parameters, {},
                                               &ParameterInterval::value, &Unknown::value);
  if (!fit.figures.end_energy || !is_as_fitted) end = EndAlong(m, friction, fit.Start());
  const FigureErrors errors = ErrorsBySlopes(fit, inference, slopes);

  // when, and a row for each stage
  std::vector<EstimatedParameter> state;
  if (m.further_starts.empty()) state.push_back({"time", m.time[m.size() - 1], "s", {}, {}});
  const double reach = StudentQuantile(inference.uncertainty.degrees_of_freedom, kIntervalLevel);
  for (int stage = 0; stage < (friction.second_thermal ? 2 : 1); ++stage) {
    EstimatedParameter one{
        stage == 0 ? "energy" : "second_energy", end[stage], m.torque_unit, {}, {}};
    // the error is from the fit where its table lacks something that E depends on, else from the parameters
    const double deviation = fit.figures.end_energy_std.value_or(
        std::sqrt(std::max(0.0, errors.covariance(stage, stage))));
    const bool has_interval =
        fit.figures.end_energy_std ? HasIntervals(inference) : errors.has_intervals;
    if (has_interval && std::isfinite(deviation)) {
      one.std = deviation;
      const double half = reach * deviation;
      one.interval95 = {{end[stage] - half, end[stage] + half}};
      // the value follows the changed parameters already
      FigureChange change = errors.by_causes[stage];
      change.shift = 0;
      Move(change, one.value, *one.interval95);
    }
    state.push_back(std::move(one));
  }
  return state;
}

Friction ReportedFriction(const Fit& fit, const Inference& inference) {
  Friction friction = fit.model.friction;
  for (size_t i = 0; i < fit.parameters.size(); ++i) {
    const Unknown& row = fit.parameters[i];
    if (IsNominal(row.role)) *row.PlaceIn(friction) = inference.parameters[i].value;
  }
  if (const auto gain = fit.RowOf(Role::gain), tau = fit.RowOf(Role::time_constant); gain && tau) {
    friction.thermal = Thermal{inference.parameters[*gain].value, inference.parameters[*tau].value};
  }
  return friction;
}

void ReportVerdict(const Inference& inference, Estimate& estimate) {
  estimate.status = inference.status;
  estimate.message = inference.message;
  estimate.warnings = inference.warnings;
  estimate.diagnostics = inference.diagnostics;
  estimate.assumptions = inference.assumptions;
}

Estimate ReportFit(const Fit& fit, const Inference& inference, const PreparedLog& log,
                   const LogSamples& measurements, RefusedNumbers numbers) {
  Estimate estimate = ReportFit(fit, inference, measurements, numbers);
  if (const auto& refusal = fit.refusal;
      refusal && refusal->unconverged && inference.status == refusal->status) {
    estimate.message += "; " + WhyNotConverged(log, *refusal->unconverged);
  }
  return estimate;
}

Estimate ReportFit(const Fit& fit, const Inference& inference, const LogSamples& measurements,
                   RefusedNumbers numbers) {
  // the identifier, the status and the message
  Estimate estimate;
  estimate.identifier = fit.identifier;
  estimate.choice = fit.choice;
  ReportVerdict(inference, estimate);

  // the iterations of the fit
  const double h = MedianStep(measurements.time);
  for (const Iterate& iterate : fit.trace) {
    estimate.trace.push_back(EntryOf(fit, iterate, h));
  }
  // whose numbers are shown
  const bool is_void = inference.refused && numbers == RefusedNumbers::show;
  const Inference& shown = is_void ? *inference.refused : inference;
  if (is_void) estimate.message += std::string("; ") + kForced;
  if (inference.parameters.empty()) return estimate;

  // the numbers
  estimate.parameters = ParametersOf(fit, shown, h);
  estimate.half_widths = HalfWidths(fit, inference);
  estimate.metrics = ComputeMetrics(fit.rows.torque, fit.rows.fitted, fit.rows.count,
                                    fit.rows.effective_parameters);
  estimate.gravity = fit.model.gravity;
  if (!shown.gives_friction) return estimate;

  // and the friction and gravity, which other programs can use
  estimate.friction = ReportedFriction(fit, shown);
  estimate.bands = BandsOf(fit, shown);
  if (!inference.gives_friction) return estimate;
  estimate.state_end = EndState(fit, inference, *estimate.friction, measurements);
  for (const SpeedFigure& one : inference.at_speeds) {
    estimate.friction_at_speeds.push_back(one.at);
  }
  // without intervals there is no covariance either
  ParameterCovariance covariance = CovarianceOfValues(fit, inference);
  if (!covariance.parameters.empty()) estimate.covariance = std::move(covariance);
  return estimate;
}

}  // namespace warmjoint
