// Identifier `energy-ml`: law and warming together, by maximum likelihood over the closed loop.
//
// (p, k, tau) = argmin sum over the kept samples of (tau - F)^2, F the response of the closed loop
// (19)-(22) to the recorded velocity: maximum likelihood for white noise on the torque. Needs no
// start: tau is scanned, then all parameters are refined together. Any law that is linear in its
// parameters; optionally E(0).
//
// Standard deviations and 95 % intervals from s^2 (J^T J)^-1 with the exact Jacobian J at the
// solution. not_identifiable where the motion cannot tell the law's parameters apart, or where the
// warm-up cannot be seen: its share of the residual is not beyond chance, or tau is not known to
// better than a factor of about e.
//
// Where the option `torque_lag` asks for a lag and the log shows one, law and warming are fitted once more behind it
// (lagged_thermal_fit.h). Where `position` names maps over the joint's or the motor's angle, these are fitted together with law and
// warming (energy_ml_maps.h), but behind no lag.
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "identification/fit_data.h"
#include "identification/fit_parameters.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/lagged/lagged_fit.h"
#include "identification/linear/linear_laws.h"
#include "identification/linear/rigid_part.h"
#include "identification/linear/robust.h"
#include "identification/maps/energy_ml_maps.h"
#include "identification/physical_bounds.h"
#include "identification/seen_samples.h"
#include "identification/uncertainty/disagreement.h"
#include "identification/warming/conclude_thermal_fit.h"
#include "identification/warming/expected_start.h"
#include "identification/warming/further_passes.h"
#include "identification/warming/lagged_thermal_fit.h"
#include "identification/warming/thermal_fit_context.h"

namespace warmjoint {
namespace {

constexpr const char* kEnergyMl = "energy-ml";

/// What whitening changes of a fit beyond doubt; nothing where the colour may be noise. plain: the
/// fit before it.
std::optional<Disagreement> FindStructure(const ThermalFitContext& course, const ThermalFit& plain,
                                          const ThermalFit& white, const Whitening& whitening) {
  const Uncertainty known = CovarianceOf(course, plain);
  return FindDisagreement({plain.solution.x, known.covariance},
                          {white.solution.x, whitening.noise().innovation * Cofactor(white.normal)},
                          known.freedom);
}

/// What the pass on whitened rows came to.
struct Whitened {
  std::shared_ptr<const Whitening> map;  // of the fit's rows; none where they are as they were
  std::optional<Disagreement> refused;   // why not, though the noise is coloured
};

/// Fits once more on whitened rows, where the noise is coloured beyond doubt; the fit stays as it was
/// where that changes more than noise may. response: of the loop by the fit
Whitened FitAgainWhitened(const ThermalFitContext& course, const LoopResponse& response,
                          ThermalFit& fit) {
  const Measurements& m = course.input.measurements;
  const ThermalFit plain = fit;
  Whitened white;
  white.map = FitWhitened(m, course.input.selection, course.loop, course.level, course.offsets,
                          course.spread, response, fit);
  if (!white.map) return white;

  // back to the plain fit where whitening changes too much, or leaves the bounds
  white.refused = FindStructure(course, plain, fit, *white.map);
  if (white.refused || LeavesBounds(LawParameters(course.task.law, fit.parameters(), m))) {
    fit = plain;
    white.map = nullptr;
  }
  return white;
}

/// After the passes by squares: under Huber's loss, or on whitened rows where the noise is coloured beyond doubt.
Fit FitFurther(const ThermalFitContext& course, const InitialGuess& start,
               RobustThermalFit robust) {
  const IdentifierInput& input = course.input;
  double nominal_squares = course.nominal_squares;
  // outliers count less, in the fit without warming as well
  if (input.options.Get<LossOption>().loss == LossKind::huber) {
    robust = RefineByHuber(course.loop, course.level, course.offsets, course.kept,
                           std::move(robust.fit), course.spread);
    const Eigen::VectorXd root = Kept(robust.weight, input.selection).col(0).cwiseSqrt();
    nominal_squares =
        LeftOver(root.asDiagonal() * course.kept_columns, root.cwiseProduct(course.torque));
  }

  // on whitened rows, and so the fit without warming
  LoopResponse response = WarmResponse(course.loop, robust.fit);
  Whitened whitened;
  if (std::isinf(robust.threshold) && course.KeepsNoRest()) {
    whitened = FitAgainWhitened(course, response, robust.fit);
  }
  if (const auto& map = whitened.map) {
    nominal_squares = LeftOver(map->Of(course.kept_columns), map->Of(course.torque));
    response = WarmResponse(course.loop, robust.fit);
  }
  return ConcludeThermalFit(kEnergyMl, course,
                            {.scanned = start,
                             .response = response,
                             .whitening = whitened.map,
                             .structure = whitened.refused},
                            robust, nominal_squares);
}

/// Behind the lag that leaves least; as without one where the log shows none.
Fit FitWithLag(const ThermalFitContext& course, const InitialGuess& start,
               RobustThermalFit robust) {
  const IdentifierInput& input = course.input;
  std::shared_ptr<const LaggedRows> lag;
  if (course.KeepsNoRest()) {
    lag = FitWithTorqueLag(
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
  const ThermalFit& warm = robust.fit;
  const LoopResponse response = WarmResponse(course.loop, warm);
  Fit fit = ConcludeThermalFit(kEnergyMl, course,
                               {.scanned = start, .response = response, .behind = kBehindLag},
                               robust, nominal_squares);
  if (fit.refusal) return fit;

  // the lag, which the model of law and warming does not know
  AddLag(lag, response.force + course.task.gravity.columns * warm.offset_values(),
         input.measurements, fit);
  return fit;
}

/// By plain squares, with what is known of E(0) and a jump of E at each gap, both of which the course learns.
RobustThermalFit FitBySquares(ThermalFitContext& course, const InitialGuess& start) {
  // first without gaps, with E(0) as the options have it
  const double scale =
      std::sqrt(course.nominal_squares / static_cast<double>(course.torque.size()));
  RobustThermalFit robust{FitThermalFriction(course.loop, course.level, course.offsets, course.kept,
                                             start, InitialEnergyOf(course.input.options), scale),
                          course.kept, kInfinity};

  // what was known of E(0), weighed by the noise that this fit leaves
  course.unlike_before = WeighStart(
      course.loop, course.level, course.offsets, course.kept,
      [&](const ThermalFit& alone) {
        return CovarianceOf(course, alone).Deviation(alone.law_parameters + 2);
      },
      robust.fit);

  // nobody knows the losses within gaps: E may jump there
  course.gaps = FindGaps(course.input.measurements);
  if (!course.gaps.empty()) {
    course.spread = FitJumps(course.loop, course.level, course.offsets, course.kept, course.gaps,
                             start, robust.fit);
  }
  return robust;
}

/// Scans tau, fits by plain squares, and then behind a lag, or by the passes that colour and outliers ask for.
Fit FitLawAndWarming(const IdentifierInput& given) {
  const LinearTask task = BeginLinear(given, 3);
  if (task.refusal) return Refused(kEnergyMl, *task.refusal);
  const IdentifierInput input = task.gravity.Of(given);

  // the columns of law and gravity must be distinct before any warming is thought of
  ThermalFitContext course(input, task);
  if (!course.nominal.mixed.empty()) {
    return Refused(kEnergyMl, Status::not_identifiable,
                   IndistinctColumns(course.nominal.mixed, task.law, task.gravity, input));
  }

  // scan tau, then refine everything over the closed loop
  const InitialGuess start = Scan(course, course.level);
  RobustThermalFit robust = FitBySquares(course, start);
  Fit fit = AsksForLag(input.options) ? FitWithLag(course, start, std::move(robust))
                                      : FitFurther(course, start, std::move(robust));
  if (!course.unlike_before.empty()) fit.warnings.push_back(course.unlike_before);
  return fit;
}

Fit FitAsAsked(const IdentifierInput& input) {
  // what cannot be had together
  if (auto why = WhyNoLag(input)) return Refused(kEnergyMl, Status::bad_data, *why);
  if (input.options.Get<WarmMapOptions>().position == WarmMap::none) {
    return FitLawAndWarming(input);
  }
  if (AsksForLag(input.options)) {
    return Refused(kEnergyMl, Status::bad_data,
                   "torque_lag is estimated beside a law without maps; use position none, or "
                   "torque_lag none");
  }
  return FitWithMaps(kEnergyMl, input);
}

}  // namespace

Identifier EnergyMl() {
  return {kEnergyMl,
          "law and warming together by maximum likelihood over the closed loop; needs no start",
          OptionGroups<LawOption, InitialEnergyOptions, GravityOption, MotionOption, LossOption,
                       LagOption, WarmMapOptions>{},
          &FitAsAsked};
}

}  // namespace warmjoint
