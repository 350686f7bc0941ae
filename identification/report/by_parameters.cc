#include "identification/report/by_parameters.h"

#include <cmath>

namespace warmjoint::inline identification {
namespace {

/// Friction and start with one row of the table at another value. jump: which one, of a row that is one
void Set(const FitParameter& row, size_t jump, double value, FrictionDescription& friction,
         CourseStart& start) {
  if (row.role == Role::law) friction.parameters[row.name] = value;
  if (row.role == Role::start) start.energy = value;
  if (row.role == Role::jump) start.jumps[jump].change = value;
  if (row.role != Role::heat) return;

  // of the two rows of heat, the time constant is the one told by its logarithm
  const bool gain = row.coordinate != Coordinate::logarithm;
  (gain ? friction.thermal->gain : friction.thermal->time_constant) = value;
}

}  // namespace

FigureErrors ErrorsByParameters(const Fit& fit, const Inference& inference,
                                const FrictionDescription& friction, const FiguresOf& figures) {
  const Uncertainty& known = inference.known;
  const Eigen::Index q = figures(friction, fit.Start()).size();
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(q, known.covariance.rows());
  FigureErrors errors{{}, Eigen::VectorXd::Zero(q), fit.without_intervals.empty()};

  // only what is estimated has a column of the covariance; each jump has a number of its own
  Eigen::Index column = 0;
  size_t jumps = 0;
  for (size_t i = 0; i < fit.parameters.size(); ++i) {
    const FitParameter& row = fit.parameters[i];
    if (!row.estimated) continue;
    const Eigen::Index place = column++;
    const size_t jump = jumps;
    if (row.role == Role::jump) ++jumps;
    // gravity, inertia and a lag of the torque leave friction and start as they are
    const bool matters = row.role == Role::law || row.role == Role::heat ||
                         row.role == Role::start || row.role == Role::jump;
    if (!matters || row.name.empty()) continue;
    errors.told = errors.told && inference.parameters[i].interval95;
    const double deviation = known.Deviation(place);

    // a step of one standard deviation of the value; one that could turn a sign gives no slope
    const bool by_logarithm = row.coordinate == Coordinate::logarithm;
    const double value = inference.parameters[i].value;
    const double step = by_logarithm ? value * deviation : deviation;
    const bool keeps_its_sign = row.role == Role::law || row.role == Role::heat;
    if (!(step > 0) || (keeps_its_sign && !(step < std::abs(value)))) continue;

    // slopes over the coordinate, by the figures on both sides
    FrictionDescription above = friction, below = friction;
    CourseStart above_start = fit.Start(), below_start = fit.Start();
    Set(row, jump, value + step, above, above_start);
    Set(row, jump, value - step, below, below_start);
    slopes.col(place) =
        (figures(above, above_start) - figures(below, below_start)) / (2 * deviation);
    // what the verdict widened is a move of the value, not of its coordinate
    errors.widened +=
        slopes.col(place).cwiseAbs() * (deviation / step) * inference.parameters[i].widened;
  }

  // noise moves all of them together, to first order
  errors.covariance = slopes * known.covariance * slopes.transpose();
  return errors;
}

}  // namespace warmjoint::inline identification
