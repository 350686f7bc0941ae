#include "identification/identifiers/lag_of_log.h"

#include <algorithm>

#include "identification/fit_data.h"
#include "identification/lagged/kept_runs.h"
#include "identification/lagged/lagged_fit.h"
#include "identification/lagged/seen_lag.h"

namespace warmjoint::inline identification {
namespace {

constexpr double kSettledAfter = 5;  // time constants; why 5: e^-5 = 1/150 is left

}  // namespace

std::optional<double> LagOf(const Structure& structure, const TorqueModel& without,
                            const CourseStart& start, const IdentifierInput& input) {
  const Measurements& m = input.measurements;
  if (m.acceleration || !structure.CanTellLag()) return std::nullopt;

  // whether what the model leaves shows a lag at all
  const TorquePrediction predicted = PredictTorque(without, m, input.selection, start);
  const auto runs = std::make_shared<const KeptRuns>(FindRuns(m, predicted.known));
  const Eigen::VectorXd torque = Kept(predicted.torque, predicted.known);
  const Eigen::VectorXd residual = Kept(m.torque, predicted.known) - torque;
  if (!ShowsLag(runs, torque, residual)) return std::nullopt;

  // then how long it is, by the structure that estimates it
  const Fit behind = structure.With(kLagOption, "estimated").Fitted(input);
  if (behind.refusal || !behind.torque_lag) return std::nullopt;
  return behind.torque_lag->time_constant;
}

Selection Settled(const Measurements& m, Selection selection, double lag) {
  const KeptRuns all = FindRuns(m, selection);
  for (const KeptRun& run : all.runs) {
    const double begin = all.time[run.begin];
    const double wait = std::min(kSettledAfter * lag, 0.5 * (all.time[run.end - 1] - begin));
    for (Eigen::Index i = run.begin; i < run.end && all.time[i] < begin + wait; ++i) {
      selection.keep[all.samples[static_cast<std::size_t>(i)]] = false;
    }
  }
  return selection;
}

}  // namespace warmjoint::inline identification
