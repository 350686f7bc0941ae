#include "identification/report/end_state.h"

#include <cmath>

#include "identification/report/by_parameters.h"
#include "identification/uncertainty/tails.h"
#include "models/recording/course_of.h"

namespace warmjoint {

namespace {

/// Whether the friction that is reported is the fitted one: a verdict may have moved parameters.
bool IsAsFitted(const Fit& fit, const Inference& inference) {
  for (size_t i = 0; i < fit.parameters.size(); ++i) {
    if (inference.parameters[i].value != fit.parameters[i].value) return false;
  }
  return true;
}

}  // namespace

std::vector<EstimatedParameter> EndState(const Fit& fit, const Inference& inference,
                                         const Friction& friction, const Measurements& m) {
  if (!friction.thermal) return {};

  // E of both stages at the end of the log: by the fit's own recursion, or along the motion
  const auto end_of = [&](const Friction& one, const CourseStart& start) {
    const FrictionState end = AlongMotion(one).Predict(CourseOf(m), start).end;
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

}  // namespace warmjoint
