#include "identification/report/end_state.h"

#include <cmath>

#include "identification/uncertainty/tails.h"
#include "models/recording/course_of.h"

namespace warmjoint::inline identification {
namespace {

/// E1 and E2 at the last sample.
Eigen::Vector2d EndOf(const FrictionDescription& friction, const CourseStart& start,
                      const Measurements& m) {
  const FrictionState end = PredictFriction(friction, m, start).end;
  return {end.energy, end.second_energy};
}

/// Friction and start with one row of the table at another value.
void Set(const FitParameter& row, double value, FrictionDescription& friction, CourseStart& start) {
  if (row.role == Role::law) friction.parameters[row.name] = value;
  if (row.role == Role::start) start.energy = value;
  if (row.role != Role::heat) return;
  const bool gain = row.coordinate != Coordinate::logarithm;
  (gain ? friction.thermal->gain : friction.thermal->time_constant) = value;
}

}  // namespace

std::vector<EstimatedParameter> EndState(const Fit& fit, const Inference& inference,
                                         const FrictionDescription& friction,
                                         const Measurements& m) {
  if (!friction.thermal) return {};
  const Eigen::Vector2d end = EndOf(friction, fit.Start(), m);

  // how it follows the parameters, each by a standard deviation of its coordinate
  const Uncertainty& known = inference.known;
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(2, known.covariance.rows());
  Eigen::Vector2d widened = Eigen::Vector2d::Zero();
  bool told = fit.without_intervals.empty();
  Eigen::Index column = 0;
  for (size_t i = 0; i < fit.parameters.size(); ++i) {
    const FitParameter& row = fit.parameters[i];
    if (!row.estimated) continue;
    const Eigen::Index place = column++;
    const bool matters = row.role == Role::law || row.role == Role::heat || row.role == Role::start;
    if (!matters || row.name.empty()) continue;
    told = told && inference.parameters[i].interval95;
    const double deviation = known.Deviation(place);
    const bool by_logarithm = row.coordinate == Coordinate::logarithm;
    const double value = inference.parameters[i].value;
    const double step = by_logarithm ? value * deviation : deviation;
    if (!(step > 0) || !(step < std::abs(value))) continue;
    FrictionDescription above = friction, below = friction;
    CourseStart above_start = fit.Start(), below_start = fit.Start();
    Set(row, value + step, above, above_start);
    Set(row, value - step, below, below_start);
    slopes.col(place) =
        (EndOf(above, above_start, m) - EndOf(below, below_start, m)) / (2 * deviation);
    widened += slopes.col(place).cwiseAbs() * (deviation / step) * inference.parameters[i].widened;
  }

  // a row for each stage
  std::vector<EstimatedParameter> state;
  const double reach = StudentQuantile(known.freedom, kIntervalLevel);
  for (int stage = 0; stage < (friction.second_thermal ? 2 : 1); ++stage) {
    EstimatedParameter one{
        stage == 0 ? "energy" : "second_energy", end[stage], m.torque_unit, {}, {}};
    const double deviation =
        std::sqrt(std::max(0.0, (slopes.row(stage) * known.covariance).dot(slopes.row(stage))));
    if (told && std::isfinite(deviation)) {
      one.std = deviation;
      const double half = reach * deviation + widened[stage];
      one.interval95 = {{end[stage] - half, end[stage] + half}};
    }
    state.push_back(std::move(one));
  }
  return state;
}

}  // namespace warmjoint::inline identification
