// Identifier `stribeck`: the Stribeck law, with or without warming.
//
// (kv, kc, ks, vs[, k, tau]) = argmin sum over the kept samples of (tau - F)^2, F the Stribeck law,
// or the one with a level for each direction (kc+, kc- and kr for kc and ks), with a fixed exponent, closed over its losses by
// (19)-(22) where `warming` is estimated. Needs no start: vs is scanned, and the three best are refined by Ceres on the law
// itself. Standard deviations and 95 % intervals as in uncertainty.h, those of vs and tau through their logarithms.
// Gravity and inertia join it as linear columns, as they do elsewhere (rigid_part.h).
//
// not_identifiable where the motion does not determine the law without its fall; where the level at rest and
// stribeck_velocity explain no more than chance does; where vs is not known to a factor of e, or
// ks - kc not to a half of itself, which is so when slow speeds are missing. inadequate_model
// where friction rises from rest instead of falling. The trace holds the scan, by its vs.
#include <warmjoint/prepared_log.h>

#include <cmath>

#include "identification/fit/fit_data.h"
#include "identification/fit/seen_samples.h"
#include "identification/forward/log_trajectory.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/inference/bounds.h"
#include "identification/inference/inference.h"
#include "identification/linear/linear_laws.h"
#include "identification/linear/rigid_part.h"
#include "identification/model/least_squares.h"
#include "identification/nonlinear/stribeck_fit.h"
#include "identification/nonlinear/stribeck_verdict.h"
#include "identification/sentences/falls.h"
#include "identification/sentences/friction.h"
#include "identification/uncertainty/uncertainty.h"
#include "identification/warming/scan_time_constant.h"
#include "identification/warming/thermal_fit.h"
#include "identification/warming/warming_verdict.h"

namespace warmjoint {
namespace {

constexpr const char* kName = "stribeck";

/// The squares that the law without the Stribeck effect leaves, with the same warming. (N.m)^2 or N^2
double SquaresWithout(const StribeckProblem& problem) {
  const LogSamples& m = problem.measurements;
  // cold, by linear least squares
  const Eigen::MatrixXd columns = LawColumns(problem.law.without, m.velocity);
  const Eigen::VectorXd torque = Kept(m.torque, problem.selection);
  const Eigen::MatrixXd kept = Kept(BesideRigid(columns, problem), problem.selection);
  const LeastSquares cold = SolveLeastSquares(kept, torque);
  const double squares = (torque - kept * cold.solution).squaredNorm();
  if (problem.warming == PartFit::none) return squares;

  // with warming, from the best time constant of a scan
  const LawBlocks blocks(m, columns, LossColumns(problem.law.without, m), problem.rigid);
  const InitialGuess start =
      ScanWarming(columns, cold.solution.tail(problem.rigid.cols()), problem);
  const ThermalFit fit =
      FitThermalFriction({.blocks = blocks,
                          .samples = {.torque = m.torque, .keep = problem.selection.keep},
                          .scale = std::sqrt(squares / static_cast<double>(torque.size()))},
                         start);
  return std::min(squares, fit.squares);
}

/// The drop of |e|^2 / s^2 that a point brings to a law that leaves the squares `without`.
double Explained(const StribeckProblem& problem, double without, const FitPoint& point) {
  const auto degrees_of_freedom =
      static_cast<double>(problem.selection.count() - problem.places().size());
  return ExplainedVariances(without, point.squares, degrees_of_freedom,
                            Kept(problem.measurements.torque, problem.selection));
}

/// Why the level at rest and vs cannot be seen: one sentence.
std::string Unseen(const IdentifierInput& input, const FallingLaw& law, double explained) {
  return ExplainUnseenFall(law.rest(), explained > 0 ? explained : 0.0, kVisibleWarming,
                           SlowSpeeds(input.measurements, input.selection));
}

/// The squares that the law leaves without warming. (N.m)^2 or N^2
double ColdSquares(const StribeckProblem& problem) {
  StribeckProblem cold = problem;
  cold.warming = PartFit::none;
  const std::vector<FitPoint> scan = ScanStribeckVelocity(cold);
  return scan.empty() ? kInfinity : RefineStribeck(cold, scan[0]).solution.squares;
}

/// Why the warming is not identifiable; nothing where it is, or is not asked for.
std::optional<std::string> UnidentifiableHeat(const StribeckProblem& problem,
                                              const StribeckFit& fit,
                                              const Uncertainty& uncertainty) {
  if (problem.warming == PartFit::none) return std::nullopt;
  const FallingPlaces at = problem.places();
  const Eigen::VectorXd& time = problem.measurements.time;
  const double total = time[time.size() - 1] - time[0];
  const double step = fit.model->heat->loop->intervals().typical;
  return UnidentifiableWarming({.explained = Explained(problem, ColdSquares(problem), fit.solution),
                                .log_deviation = uncertainty.Deviation(at.log_time_constant()),
                                .time_constant = at.ThermalAt(fit.solution.x).time_constant,
                                .shortest = 2 * step,
                                .longest = 5 * total,
                                .step = step});
}

/// Invalidates a fit whose friction drives the joint on this motion. Where the data rule the law out, or
/// it may be within its bounds only by chance, there is no friction to simulate.
void JudgeWarmth(const LogSamples& m, std::string_view without, Fit& fit) {
  if (!fit.model.friction.thermal || !GivesFriction(fit)) return;
  const Prediction predicted = PredictFriction(fit.model.friction, m);
  if (predicted.first_driving == m.size()) return;
  fit.causes.push_back(Invalidate(
      Status::inadequate_model,
      ExplainDriving(m.time[predicted.first_driving], RemedyForNonDissipative(without))));
}

/// Puts the best fit into `fit`, or the reason why it is refused. without: squares of the law without the Stribeck effect
void Conclude(const IdentifierInput& input, const StribeckProblem& problem, const RigidPart& rigid,
              const StribeckFit& best, double without, Fit& fit) {
  if (!best.converged) {
    fit.refusal = NotConverged();
    return;
  }

  // the level at rest and vs must explain more than chance does
  const double explained = Explained(problem, without, best.solution);
  if (!(explained > kVisibleWarming)) {
    fit.refusal = {Status::not_identifiable, Unseen(input, problem.law, explained)};
    return;
  }

  // the model, and how well it fits
  const FallingPlaces at = problem.places();
  SetFallingModel(problem.law, problem.exponent, at, best.solution.x, input.measurements, fit);
  AddRigid(rigid, best.solution.x.tail(rigid.count()), input.measurements, fit);
  fit.rows.used = input.selection;
  fit.rows.torque = Kept(input.measurements.torque, fit.rows.used);
  fit.rows.fitted = best.fitted;
  fit.rows.jacobian = [model = best.model, x = best.solution.x] {
    return ModelAt(*model, x).All().derivatives;
  };
  fit.rows.errors.cofactor = best.cofactor;
  fit.rows.count = static_cast<int>(best.solution.x.size());
  fit.rows.effective_parameters = fit.rows.count;
  fit.summary = SummaryOfFall({.count = fit.rows.torque.size(),
                               .is_any_motion = input.measurements.acceleration.has_value()},
                              problem.exponent);

  // the uncertainty of the fit, and whether it is small enough
  const Uncertainty uncertainty = CovarianceOf(fit);
  const StribeckEvidence evidence = EvidenceOf(problem.law, at, best.solution.x, uncertainty);
  auto why = UnidentifiableStribeck(problem.law, evidence, input.measurements, input.selection);
  if (!why) why = UnidentifiableHeat(problem, best, uncertainty);
  if (why) {
    fit.refusal = Refusal{Status::not_identifiable, *why};
    return;
  }
  JudgeWarmth(input.measurements, problem.law.without.name, fit);
}

Fit FitStribeck(const IdentifierInput& given) {
  // where the motion does not distinguish gravity from friction, the fit is refused
  RigidPart rigid;
  if (auto why = PrepareRigid(given, rigid)) return Refused(kName, *why);
  const IdentifierInput input = rigid.Of(given);
  const LogSamples& m = input.measurements;
  const auto& options = input.options.Get<StribeckOptions>();
  const FallingLaw& law = *options.law;
  const auto levels = static_cast<size_t>(law.levels());
  if (auto why = Unusable(input, static_cast<int>(levels + rigid.count()) + 4)) {
    return Refused(kName, Status::bad_data, *why);
  }

  // the law without its fall must be identifiable before the fall is looked for
  const auto unknown = law.law.parameters.first(levels + 1);
  if (auto why = UnknownSliding(input, law, unknown, rigid.columns)) return Refused(kName, *why);

  // scan vs, then refine the best
  StribeckProblem problem{m,   input.selection, options.exponent, options.warming,
                          law, rigid.columns};
  const double without = SquaresWithout(problem);
  const std::vector<FitPoint> scan = ScanStribeckVelocity(problem);
  if (scan.empty() || !std::isfinite(without))
    return Refused(kName, NoFall(law, m, input.selection));

  // where the scan, which is within a few per cent of the best, explains next to nothing, so does the fit
  Fit fit;
  fit.identifier = kName;
  fit.trace = ScanTrace(law, options.exponent, scan, 1, input.selection.count());
  SetFallingModel(law, options.exponent, problem.places(), scan[0].x, m, fit);
  const double seen = Explained(problem, without, scan[0]);
  if (problem.warming == PartFit::none && seen < 0.5 * kVisibleWarming) {
    fit.refusal = {Status::not_identifiable, Unseen(input, law, seen)};
  } else {
    const StribeckFit best =
        BestRefined(scan, [&](const FitPoint& start) { return RefineStribeck(problem, start); });
    Conclude(input, problem, rigid, best, without, fit);
  }
  return fit;
}

}  // namespace

Identifier StribeckIdentifier() {
  return {kName, "the Stribeck law by least squares, with or without warming; needs no start",
          OptionGroups<StribeckOptions, GravityOption, MotionOption>{}, &FitStribeck};
}

}  // namespace warmjoint
