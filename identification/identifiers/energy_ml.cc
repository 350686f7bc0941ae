#include "identification/identifiers/energy_ml.h"

#include <cmath>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "identification/fit_data.h"
#include "identification/fit_parameters.h"
#include "identification/linear/rigid_part.h"
#include "identification/linear/robust.h"
#include "identification/physical_bounds.h"
#include "identification/uncertainty/disagreement.h"
#include "identification/warming/expected_start.h"
#include "identification/warming/further_passes.h"
#include "identification/warming/warm_answer.h"

namespace warmjoint::inline identification {
namespace {

/// What whitening changes of a fit beyond doubt; nothing where the colour may be noise. plain: the
/// fit before it.
std::optional<Disagreement> FindStructure(const WarmCourse& course, const WarmFit& plain,
                                          const WarmFit& white, const Whitening& whitening) {
  const Uncertainty known = KnownOf(course, plain);
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
Whitened FitAgainWhitened(const WarmCourse& course, const LoopResponse& response, WarmFit& fit) {
  const Measurements& m = course.input.measurements;
  const WarmFit plain = fit;
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

Fit FitWarming(const IdentifierInput& given) {
  return FitLawAndWarming(kEnergyMl, given, &FitFurther);
}

}  // namespace

Fit FitFurther(const WarmCourse& course, const WarmStart& start, RobustWarmFit robust) {
  const auto& [input, task] = std::tie(course.input, course.task);
  double nominal_squares = course.nominal_squares;
  // outliers count less, in the fit without warming as well
  if (input.options.Text("loss") == "huber") {
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
  return ConcludeWarm(kEnergyMl,
                      {input, task.law, task.gravity, course.loop, start, course.gaps, response,
                       whitened.map, whitened.refused},
                      robust, nominal_squares);
}

Identifier EnergyMl() {
  std::vector<OptionInfo> options{LawOption()};
  for (const OptionInfo& option : InitialEnergyOptions()) options.push_back(option);
  options.insert(options.end(), {GravityOption(), MotionOption(), LossOption()});
  return {kEnergyMl,
          "law and warming together by maximum likelihood over the closed loop; needs no start",
          options, &FitWarming};
}

}  // namespace warmjoint::inline identification
