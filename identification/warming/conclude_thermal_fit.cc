#include "identification/warming/conclude_thermal_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "identification/fit_data.h"
#include "identification/fit_parameters.h"
#include "identification/linear/least_squares.h"
#include "identification/linear/rigid_part.h"
#include "identification/linear/robust.h"
#include "identification/uncertainty/few_segments.h"
#include "identification/uncertainty/tails.h"
#include "identification/warming/warming_verdict.h"

namespace warmjoint {
namespace {

/// Why the warm-up cannot be told; nothing where it can. variance: of the noise; cofactor: of x;
/// explained: by the warming, in variances of the noise; reach: of 95 % intervals in deviations, as a multiple
/// of that of a known variance.
std::optional<std::string> WhyNotIdentifiable(const ThermalFit& fit, const InitialGuess& scanned,
                                              double variance, double explained,
                                              const Eigen::MatrixXd& cofactor, double reach) {
  if (!fit.converged) {
    if (auto why = InsignificantWarming(explained)) return why;
    return RunawayWarming(fit.thermal().time_constant, scanned.longest / kScannedBeyond);
  }
  const Eigen::Index i = fit.law_parameters + 1;
  return UnidentifiableWarming({explained, reach * std::sqrt(variance * cofactor(i, i)),
                                fit.thermal().time_constant, scanned.shortest, scanned.longest,
                                scanned.longest / kScannedBeyond});
}

/// The table of parameters in the order of x: law, heat, E(0), jumps, gravity.
void FillTable(const ThermalFit& warm, const Law& law, const RigidPart& gravity,
               const Measurements& m, Fit& fit) {
  fit.parameters = LawParameters(law, warm.parameters(), m);
  Append(HeatTable(warm, m), fit);
  AddRigid(gravity, warm.offset_values(), m, fit);
}

std::vector<Iterate> Trace(const ThermalFit& warm, Eigen::Index n) {
  std::vector<Iterate> trace;
  for (const ThermalIterate& iterate : warm.trace) {
    Iterate& entry = trace.emplace_back();
    entry.iteration = static_cast<int>(trace.size()) - 1;
    entry.rmse = std::sqrt(iterate.squares / static_cast<double>(n));
    // law, gain and time constant, which the fit knew by its logarithm
    const Eigen::Index d = warm.law_parameters;
    entry.values.assign(iterate.x.begin(), iterate.x.begin() + d + 2);
    entry.values.back() = std::exp(entry.values.back());
  }
  return trace;
}

/// What the errors of a fit follow from, whatever its loss. residual: [n]
ErrorModel ErrorsOf(const ThermalFitContext& course, const ThermalPasses& passes,
                    const RobustThermalFit& robust, const Eigen::VectorXd& residual) {
  ErrorModel errors;
  errors.prior = robust.fit.prior();
  // least squares: the normal matrix of the fit serves
  if (std::isinf(robust.threshold)) {
    errors.cofactor = Cofactor(robust.fit.normal);
    errors.whitening = passes.whitening;
    return errors;
  }
  const Eigen::MatrixXd rows =
      Kept(WarmJacobian(course.loop, course.task.gravity, robust.fit), course.input.selection);
  Eigen::MatrixXd normal = rows.transpose() * rows;
  normal.diagonal() += errors.prior;
  errors.cofactor = Cofactor(normal);
  errors.scores = HuberScores(residual, robust.threshold);
  return errors;
}

/// Why there is no fit to trust; nothing where there is. nominal_squares: of the fit without
/// warming.
std::optional<Refusal> WhyRefused(const char* name, const ThermalFitContext& course,
                                  const ThermalPasses& passes, const ThermalFit& warm,
                                  double nominal_squares) {
  const IdentifierInput& input = course.input;
  const Measurements& m = input.measurements;
  const auto n = input.selection.count();
  // variance of the noise, and how much wider few segments make an interval
  const double variance = warm.solution.squares / static_cast<double>(n - warm.solution.x.size());
  const auto p = warm.solution.x.size();
  const double explained =
      ExplainedVariances(nominal_squares, warm.solution.squares, static_cast<double>(n - p),
                         Kept(m.torque, input.selection));
  const double reach = StudentQuantile(FewestFreedom(input.selection, p), kIntervalLevel) /
                       StudentQuantile(kInfinity, kIntervalLevel);
  // no warming to see, no end of the iterations, or a friction that feeds itself
  if (auto why = WhyNotIdentifiable(warm, passes.scanned, variance, explained,
                                    Cofactor(warm.normal), reach)) {
    return Refusal{Status::not_identifiable, *why};
  }
  if (!warm.converged) {
    return Refusal{
        Status::not_converged,
        fmt::format("the fit has not converged after {} iterations", warm.trace.size() - 1),
        FrictionKind::warm_up};
  }
  if (const auto& feeds_itself = passes.response.feeds_itself) {
    return Refusal{
        Status::inadequate_model,
        WouldFeedItself(m.time[*feeds_itself],
                        RemedyForNonDissipative(name, course.task.law.name,
                                                input.options.Get<GravityOption>().gravity))};
  }
  return std::nullopt;
}

}  // namespace

std::vector<FitParameter> HeatTable(const ThermalFit& warm, const Measurements& measurements) {
  std::vector<FitParameter> rows = HeatParameters(warm.thermal(), measurements);
  if (warm.estimates_initial_energy()) {
    rows.push_back(StartParameter(warm.initial_energy(), measurements));
  }
  std::ranges::copy(JumpParameters(warm.jump_values(), measurements), std::back_inserter(rows));
  return rows;
}

LoopResponse WarmResponse(const ClosedLoop& loop, const ThermalFit& fit) {
  return loop.Simulate(fit.parameters(), fit.thermal(), fit.initial_energy(), fit.jump_values());
}

Eigen::MatrixXd WarmJacobian(const ClosedLoop& loop, const RigidPart& gravity,
                             const ThermalFit& fit) {
  const Thermal thermal = fit.thermal();
  const Eigen::MatrixXd all =
      loop.Jacobian(fit.parameters(), thermal, fit.initial_energy(), fit.jump_values());
  const Eigen::Index first = fit.law_parameters + (fit.estimates_initial_energy() ? 3 : 2);
  Eigen::MatrixXd jacobian = all.leftCols(first);
  jacobian.col(fit.law_parameters + 1) *= thermal.time_constant;  // from tau to log(tau)
  jacobian = ConcatColumns(jacobian, all.rightCols(fit.jump_weights.size()));
  return ConcatColumns(jacobian, gravity.columns);
}

EndEnergy WarmEnd(const ClosedLoop& loop, const ThermalFit& fit) {
  const LoopEnd end =
      loop.End(fit.parameters(), fit.thermal(), fit.initial_energy(), fit.jump_values());
  const Eigen::Index first = fit.law_parameters + (fit.estimates_initial_energy() ? 3 : 2);
  const Eigen::Index jumps = fit.jump_weights.size();
  EndEnergy result{end.energy, Eigen::VectorXd(first + jumps)};
  result.slopes << end.slopes.head(first), end.slopes.tail(jumps);
  return result;
}

Fit ConcludeThermalFit(const char* name, const ThermalFitContext& course,
                       const ThermalPasses& passes, const RobustThermalFit& robust,
                       double nominal_squares) {
  const IdentifierInput& input = course.input;
  const LinearTask& task = course.task;
  const Measurements& m = input.measurements;
  const ThermalFit& warm = robust.fit;
  const Eigen::VectorXd& force = passes.response.force;
  Fit fit;
  fit.identifier = name;
  fit.trace = Trace(warm, input.selection.count());
  fit.refusal = WhyRefused(name, course, passes, warm, nominal_squares);
  FillTable(warm, task.law, task.gravity, m, fit);
  if (fit.refusal) return fit;

  // the model
  fit.friction = FrictionOf(task.law, warm.parameters(), m);
  fit.friction.thermal = warm.thermal();
  fit.initial_energy = warm.initial_energy();
  fit.jump_samples = course.loop.jumps();

  // and how well it fits
  fit.used = input.selection;
  fit.torque = Kept(m.torque, fit.used);
  fit.fitted = Kept(force + task.gravity.columns * warm.offset_values(), fit.used);
  fit.errors = ErrorsOf(course, passes, robust, fit.residual());
  const auto loop = std::make_shared<const ClosedLoop>(course.loop);
  fit.jacobian = [loop, gravity = task.gravity, warm] {
    return WarmJacobian(*loop, gravity, warm);
  };
  fit.end_energy = [loop, warm] { return WarmEnd(*loop, warm); };
  if (passes.structure) fit.unmodelled_residual = {*passes.structure, Kept(force, fit.used)};
  // parameters and loss, as reports tell them
  fit.count = static_cast<int>(warm.solution.x.size());
  fit.effective_parameters = fit.count;
  if (!std::isinf(robust.threshold)) fit.loss_bend = robust.threshold;
  fit.summary = fmt::format("maximum likelihood on {} samples{}{}{}, refined in {} iterations",
                            fit.torque.size(), m.acceleration ? kOfAnyMotion : "", passes.behind,
                            passes.whitening ? kWhitened : "", warm.trace.size() - 1);
  if (!course.gaps.empty()) fit.warnings.push_back(LossesInGaps(course.gaps, m));
  return fit;
}

}  // namespace warmjoint
