#include "identification/identifiers/energy_ml_behind_lag.h"

#include <memory>
#include <tuple>
#include <utility>

#include "identification/identifiers/energy_ml.h"
#include "identification/lagged/lagged_fit.h"
#include "identification/warming/lagged_warm_fit.h"
#include "identification/warming/warm_answer.h"

namespace warmjoint::inline identification {
namespace {

/// Behind the lag that leaves least; as without one where the log shows none.
Fit FitWithLag(const WarmCourse& course, const WarmStart& start, RobustWarmFit robust) {
  const auto& [input, task] = std::tie(course.input, course.task);
  std::shared_ptr<const LaggedRows> lag;
  if (course.KeepsNoRest()) {
    lag = FitBehindLag(
        input.measurements, course.moving, course.loop, course.offsets, course.spread,
        [&](const Eigen::VectorXd& level) { return Scan(course, level); }, robust.fit);
  }
  if (!lag) {
    Fit fit = FitFurther(course, start, std::move(robust));
    if (!fit.refusal) fit.afterword = kNoLagSeen;
    return fit;
  }

  // the fit without warming, on the same rows
  const double nominal_squares =
      LeftOver(lag->Of(course.kept_columns), lag->Of(lag->Unlagged(course.torque)));
  const WarmFit& warm = robust.fit;
  const LoopResponse response = WarmResponse(course.loop, warm);
  Fit fit = ConcludeWarm(kEnergyMl,
                         {input,
                          task.law,
                          task.gravity,
                          course.loop,
                          start,
                          course.gaps,
                          response,
                          nullptr,
                          {},
                          kBehindLag},
                         robust, nominal_squares);
  if (fit.refusal) return fit;

  // the lag, which the model of law and warming does not know
  AddLag(lag, response.force + task.gravity.columns * warm.offset_values(), input.measurements,
         fit);
  return fit;
}

Fit FitAsAsked(const IdentifierInput& input) {
  static const Identifier plain = EnergyMl();
  if (!AsksForLag(input)) return plain.fit(input);
  if (auto why = WhyNoLag(input)) return Refused(kEnergyMl, Status::bad_data, *why);
  return FitLawAndWarming(kEnergyMl, input, &FitWithLag);
}

}  // namespace

Identifier EnergyMlBehindLag() {
  Identifier identifier = EnergyMl();
  identifier.options.push_back(TorqueLagOption());
  identifier.fit = &FitAsAsked;
  return identifier;
}

}  // namespace warmjoint::inline identification
