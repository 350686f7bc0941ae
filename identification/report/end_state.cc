#include "identification/report/end_state.h"

#include <warmjoint/friction_model.h>

#include <Eigen/Core>
#include <cmath>
#include <functional>

#include "identification/fit.h"
#include "identification/forward/log_trajectory.h"
#include "identification/inference/apply.h"
#include "identification/inference/inference.h"
#include "identification/uncertainty/tails.h"
#include "models/friction/along_motion.h"

namespace warmjoint {
namespace {

/// Some figures of a friction and the start of its log. [q]
using FiguresOf =
    std::function<Eigen::VectorXd(const Friction& friction, const ThermalStart& start)>;

/// Their errors.
struct FigureErrors {
  Eigen::MatrixXd covariance;  // [q x q] by noise
  Eigen::VectorXd widened;  // [q] how much farther their intervals reach by what the verdict found
  bool has_intervals = true;  // whether every parameter that matters has an interval
};

/// An estimated row of the table: its place there, among the estimated ones, and among those of its role.
struct EstimatedRow {
  size_t row = 0;
  Eigen::Index column = 0;
  size_t jump = 0;  // of a row that is one
};

/// Those that friction and start depend on: gravity, inertia and a lag of the torque leave them as they are.
std::vector<EstimatedRow> RowsThatMatter(const Fit& fit) {
  std::vector<EstimatedRow> rows;
  EstimatedRow at;
  for (; at.row < fit.parameters.size(); ++at.row) {
    const FitParameter& row = fit.parameters[at.row];
    if (!row.estimated) continue;
    const bool matters = row.role == Role::law || row.role == Role::heat ||
                         row.role == Role::start || row.role == Role::jump;
    if (matters && !row.name.empty()) rows.push_back(at);
    if (row.role == Role::jump) ++at.jump;
    ++at.column;
  }
  return rows;
}

/// Friction and start with one row of the table at another value.
void Set(const FitParameter& row, size_t jump, double value, Friction& friction,
         ThermalStart& start) {
  if (row.role == Role::law) friction.parameters[row.name] = value;
  if (row.role == Role::start) start.energy = value;
  if (row.role == Role::jump) start.jumps[jump].change = value;
  if (row.role != Role::heat) return;

  // of the two rows of heat, the time constant is the one told by its logarithm
  const bool gain = row.coordinate != Coordinate::logarithm;
  (gain ? friction.thermal->gain : friction.thermal->time_constant) = value;
}

/// What a change of the coordinate by 1 changes of the value, to first order.
double ValueByCoordinate(const FitParameter& row, double value) {
  return row.coordinate == Coordinate::logarithm ? value : 1;
}

/// Slopes of the figures over the parameters of law, heat, start and jumps, each in its coordinate, by central
/// differences of a standard deviation; 0 over all others. [q x p]
Eigen::MatrixXd SlopesByDifferences(const Fit& fit, const Inference& inference,
                                    const Friction& friction, const FiguresOf& figures) {
  const Uncertainty& known = inference.known;
  const Eigen::Index q = figures(friction, fit.Start()).size();
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(q, known.covariance.rows());
  for (const EstimatedRow& at : RowsThatMatter(fit)) {
    const FitParameter& row = fit.parameters[at.row];
    const double value = inference.parameters[at.row].value;
    const double deviation = known.Deviation(at.column);

    // a step of one standard deviation of the value; one that could turn a sign gives no slope
    const double step = ValueByCoordinate(row, value) * deviation;
    const bool keeps_its_sign = row.role == Role::law || row.role == Role::heat;
    if (!(step > 0) || (keeps_its_sign && !(step < std::abs(value)))) continue;

    // the figures on both sides
    Friction above = friction, below = friction;
    ThermalStart above_start = fit.Start(), below_start = fit.Start();
    Set(row, at.jump, value + step, above, above_start);
    Set(row, at.jump, value - step, below, below_start);
    slopes.col(at.column) =
        (figures(above, above_start) - figures(below, below_start)) / (2 * deviation);
  }
  return slopes;
}

/// From the covariance of the parameters, to first order. slopes: [q x p], over the coordinates.
FigureErrors ErrorsBySlopes(const Fit& fit, const Inference& inference,
                            const Eigen::MatrixXd& slopes) {
  FigureErrors errors{slopes * inference.known.covariance * slopes.transpose(),
                      Eigen::VectorXd::Zero(slopes.rows()), true};
  Eigen::MatrixXd by_value = Eigen::MatrixXd::Zero(slopes.rows(), std::ssize(inference.parameters));
  for (const EstimatedRow& at : RowsThatMatter(fit)) {
    const ParameterInterval& known = inference.parameters[at.row];
    errors.has_intervals = errors.has_intervals && known.interval95;
    // causes change the value, not its coordinate
    by_value.col(static_cast<Eigen::Index>(at.row)) =
        slopes.col(at.column) / ValueByCoordinate(fit.parameters[at.row], known.value);
  }
  for (Eigen::Index i = 0; i < by_value.rows(); ++i) {
    errors.widened[i] = ChangeOf(inference.causes, by_value.row(i)).reach;
  }
  return errors;
}

/// Whether the friction that is reported is the fitted one: a verdict may have moved parameters.
bool IsAsFitted(const Fit& fit, const Inference& inference) {
  for (size_t i = 0; i < fit.parameters.size(); ++i) {
    if (inference.parameters[i].value != fit.parameters[i].value) return false;
  }
  return true;
}

}  // namespace

std::vector<EstimatedParameter> EndState(const Fit& fit, const Inference& inference,
                                         const Friction& friction, const LogSamples& m) {
  if (!friction.thermal) return {};

  // E of both stages at the end of the log: by the fit's own recursion, or along the motion
  const auto end_of = [&](const Friction& one, const ThermalStart& start) {
    const FrictionState end = AlongMotion(one).Predict(TrajectoryOf(m), start).end;
    return Eigen::VectorXd(Eigen::Vector2d(end.energy, end.second_energy));
  };
  Eigen::VectorXd end;
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(2, inference.known.covariance.rows());
  if (fit.end_energy) {
    const EndEnergy own = fit.end_energy();
    end = Eigen::Vector2d(own.value, 0);
    slopes.row(0).head(own.slopes.size()) = own.slopes;
  } else {
    slopes = SlopesByDifferences(fit, inference, friction, end_of);
  }
  if (!fit.end_energy || !IsAsFitted(fit, inference)) end = end_of(friction, fit.Start());
  const FigureErrors errors = ErrorsBySlopes(fit, inference, slopes);

  // when, and a row for each stage
  std::vector<EstimatedParameter> state;
  if (m.further_starts.empty()) state.push_back({"time", m.time[m.size() - 1], "s", {}, {}});
  const double reach = StudentQuantile(inference.known.degrees_of_freedom, kIntervalLevel);
  for (int stage = 0; stage < (friction.second_thermal ? 2 : 1); ++stage) {
    EstimatedParameter one{
        stage == 0 ? "energy" : "second_energy", end[stage], m.torque_unit, {}, {}};
    // from the fit where its table does not hold all that E depends on, else from the parameters
    const double deviation =
        fit.end_energy_std.value_or(std::sqrt(std::max(0.0, errors.covariance(stage, stage))));
    const bool has_interval = fit.end_energy_std ? HasIntervals(inference) : errors.has_intervals;
    if (has_interval && std::isfinite(deviation)) {
      one.std = deviation;
      const double half = reach * deviation + errors.widened[stage];
      one.interval95 = {{end[stage] - half, end[stage] + half}};
    }
    state.push_back(std::move(one));
  }
  return state;
}

}  // namespace warmjoint
