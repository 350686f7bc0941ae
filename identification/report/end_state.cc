#include "identification/report/end_state.h"

#include <cmath>

#include "identification/report/by_parameters.h"
#include "identification/uncertainty/tails.h"
#include "models/recording/course_of.h"

namespace warmjoint::inline identification {

namespace {

/// Slopes of E of both stages over the estimated coordinates, [2 x p]: the fit's own, or by differences.
Eigen::MatrixXd EndSlopes(const Fit& fit, const Inference& inference,
                          const FrictionDescription& friction, const FiguresOf& end_of) {
  if (!fit.end_energy_slopes) return SlopesByDifferences(fit, inference, friction, end_of);
  const Eigen::VectorXd first = fit.end_energy_slopes();
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(2, inference.known.covariance.rows());
  slopes.row(0).head(first.size()) = first;
  return slopes;
}

}  // namespace

std::vector<EstimatedParameter> EndState(const Fit& fit, const Inference& inference,
                                         const FrictionDescription& friction,
                                         const Measurements& m) {
  if (!friction.thermal) return {};

  // E of both stages at the end of the log, as friction and start make it
  const JointCourse course = CourseOf(m);
  const auto end_of = [&](const FrictionDescription& one, const CourseStart& start) {
    const FrictionState end = AlongMotion(one).Predict(course, start).end;
    return Eigen::VectorXd(Eigen::Vector2d(end.energy, end.second_energy));
  };
  const Eigen::VectorXd end = end_of(friction, fit.Start());
  const FigureErrors errors =
      ErrorsBySlopes(fit, inference, EndSlopes(fit, inference, friction, end_of));

  // when, and a row for each stage
  std::vector<EstimatedParameter> state;
  if (m.starts.empty()) state.push_back({"time", m.time[m.size() - 1], "s", {}, {}});
  const double reach = StudentQuantile(inference.known.freedom, kIntervalLevel);
  for (int stage = 0; stage < (friction.second_thermal ? 2 : 1); ++stage) {
    EstimatedParameter one{
        stage == 0 ? "energy" : "second_energy", end[stage], m.torque_unit, {}, {}};
    // from the fit where its table does not hold all that E depends on, else from the parameters
    const double deviation =
        fit.end_energy_std.value_or(std::sqrt(std::max(0.0, errors.covariance(stage, stage))));
    const bool told = fit.end_energy_std ? inference.without_intervals.empty() : errors.told;
    if (told && std::isfinite(deviation)) {
      one.std = deviation;
      const double half = reach * deviation + errors.widened[stage];
      one.interval95 = {{end[stage] - half, end[stage] + half}};
    }
    state.push_back(std::move(one));
  }
  return state;
}

}  // namespace warmjoint::inline identification
