#include "identification/report/by_parameters.h"

#include <cmath>

namespace warmjoint {
namespace {

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
         CourseStart& start) {
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

}  // namespace

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
    CourseStart above_start = fit.Start(), below_start = fit.Start();
    Set(row, at.jump, value + step, above, above_start);
    Set(row, at.jump, value - step, below, below_start);
    slopes.col(at.column) =
        (figures(above, above_start) - figures(below, below_start)) / (2 * deviation);
  }
  return slopes;
}

FigureErrors ErrorsBySlopes(const Fit& fit, const Inference& inference,
                            const Eigen::MatrixXd& slopes) {
  FigureErrors errors{slopes * inference.known.covariance * slopes.transpose(),
                      Eigen::VectorXd::Zero(slopes.rows()), inference.without_intervals.empty()};
  for (const EstimatedRow& at : RowsThatMatter(fit)) {
    const KnownParameter& known = inference.parameters[at.row];
    errors.told = errors.told && known.interval95;
    // what the verdict widened is a move of the value, not of its coordinate
    const double by_value = 1 / ValueByCoordinate(fit.parameters[at.row], known.value);
    errors.widened += slopes.col(at.column).cwiseAbs() * std::abs(by_value) * known.widened;
  }
  return errors;
}

}  // namespace warmjoint
