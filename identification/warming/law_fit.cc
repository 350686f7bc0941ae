#include "identification/warming/law_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "identification/fit/fit_data.h"
#include "identification/fit/fit_parameters.h"
#include "identification/lagged/lagged_fit.h"
#include "identification/linear/huber.h"
#include "identification/linear/rigid_part.h"
#include "identification/sentences/fit.h"
#include "identification/sentences/friction.h"
#include "identification/sentences/heat.h"
#include "identification/uncertainty/few_segments.h"
#include "identification/uncertainty/tails.h"
#include "identification/warming/warming_verdict.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

/// Why the warm-up is not identifiable; nothing where it is.
std::optional<std::string> WhyNotIdentifiable(const LawFit& law) {
  const ThermalFit& fit = law.fit;
  // variance of the noise, and how much wider few segments make an interval
  const Selection& selection = law.input().selection;
  const Eigen::Index p = fit.x.size();
  const auto degrees_of_freedom = static_cast<double>(selection.count() - p);
  const double explained = ExplainedVariances(law.nominal_squares, fit.squares, degrees_of_freedom,
                                              Kept(law.measurements().torque, selection));
  const double longest = law.scanned.longest / kScannedBeyond;
  if (!fit.converged) {
    if (auto why = InsignificantWarming(explained)) return why;
    return RunawayWarming(fit.thermal().time_constant, longest);
  }
  const double reach = StudentQuantile(FewestFreedom(selection, p), kIntervalLevel) /
                       StudentQuantile(kInfinity, kIntervalLevel);
  const double deviation =
      fit.Deviation(fit.At(Role::time_constant).begin, fit.squares / degrees_of_freedom);
  return UnidentifiableWarming({explained, reach * deviation, fit.thermal().time_constant,
                                law.scanned.shortest, law.scanned.longest, longest,
                                MedianStep(law.measurements().time)});
}

/// Why the fit is refused; nothing where it is not.
std::optional<Refusal> WhyRefused(const LawFit& law, const ThermalResponse& response) {
  if (!law.fit.has_heat()) {
    if (law.fit.converged) return std::nullopt;
    return Refusal{Status::not_converged, kWeightsStillMove};
  }
  // no warming to see, no end of the iterations, or a friction that drives the joint
  if (auto why = WhyNotIdentifiable(law)) return Refusal{Status::not_identifiable, *why};
  if (!law.fit.converged) {
    return Refusal{Status::not_converged, ExplainUnconverged(law.fit.trace.size() - 1),
                   FrictionKind::warm_up};
  }
  if (!response.first_driving) return std::nullopt;
  const FittedGravity gravity = law.input().options.OrDefault<GravityOption>().gravity;
  return Refusal{Status::inadequate_model,
                 ExplainDriving(law.measurements().time[*response.first_driving],
                                RemedyForNonDissipative(law.problem.task().law.name, gravity))};
}

std::vector<Iterate> TraceOf(const ThermalFit& warm, Eigen::Index n) {
  std::vector<Iterate> trace;
  for (const FitPoint& iterate : warm.trace) {
    Iterate& entry = trace.emplace_back();
    entry.iteration = static_cast<int>(trace.size()) - 1;
    entry.rmse = std::sqrt(iterate.squares / static_cast<double>(n));
    // law, gain and time constant, which the fit has as its logarithm
    const Eigen::Index count = warm.At(Role::time_constant).end();
    entry.values.assign(iterate.x.begin(), iterate.x.begin() + count);
    entry.values.back() = std::exp(entry.values.back());
  }
  return trace;
}

/// The rows and residuals from which the errors of a fit follow, for any loss. fit: with its Jacobian and residual
void SetErrors(const LawFit& law, Fit& fit) {
  fit.rows.errors.prior = law.fit.prior;
  fit.rows.errors.cofactor = law.fit.cofactor;
  fit.rows.errors.whitening = law.whitening;
  if (std::isinf(law.threshold)) return;
  // with Huber's loss: plain columns and the scores of the loss
  fit.rows.errors.scores = HuberScores(fit.rows.residual(), law.threshold);
  fit.rows.errors.cofactor = CofactorOf(fit);
}

/// What was done: a clause.
std::string Summary(const LawFit& law) {
  const FittedSamples samples{.count = law.input().selection.count(),
                              .is_any_motion = law.measurements().acceleration.has_value(),
                              .is_lagged = law.lag != nullptr,
                              .is_whitened = law.whitening != nullptr};
  return law.fit.has_heat() ? SummaryOfLikelihood(samples, law.fit.trace.size() - 1)
                            : SummaryOfLeastSquares(law.problem.task().law.name, samples);
}

/// The table of parameters in the order of x: law, heat, E(0), jumps, gravity and inertia.
void FillTable(const LawFit& law, Fit& fit) {
  const LogSamples& m = law.measurements();
  const Eigen::VectorXd values = law.fit.law();
  fit.parameters =
      WithValues(LawUnknowns(law.problem.task().law, values.size(), UnitsOf(m)), values);
  if (law.fit.has_heat()) Append(HeatTable(law.fit, law.problem.gaps(), m), fit);
  AddRigid(law.problem.task().gravity, law.fit.rigid(), m, fit);
}

}  // namespace

Fit ConcludeLaw(LawFit law) {
  const LogSamples& m = law.measurements();
  const ThermalFit& found = law.fit;
  const ThermalResponse response = law.problem.Respond(found);
  Fit fit;
  fit.identifier = law.name;
  fit.trace = TraceOf(found, law.input().selection.count());
  fit.refusal = WhyRefused(law, response);
  FillTable(law, fit);
  if (fit.refusal) return fit;

  // the model
  fit.model.friction = FrictionOf(law.problem.task().law, found.law(), m);
  // and how well it fits
  fit.rows.used = law.input().selection;
  fit.rows.torque = Kept(m.torque, fit.rows.used);
  fit.rows.fitted = Kept(response.torque, fit.rows.used);
  fit.rows.jacobian = [found] { return LawProblem::JacobianOf(found); };
  SetErrors(law, fit);
  fit.rows.count = static_cast<int>(found.x.size());
  fit.rows.effective_parameters = fit.rows.count;
  if (!std::isinf(law.threshold)) fit.rows.loss_bend = law.threshold;
  fit.summary = Summary(law);

  // the heat
  if (found.has_heat()) {
    fit.model.friction.thermal = found.thermal();
    fit.start.energy = found.initial_energy();
    fit.start.jump_samples = found.model->heat->jump_samples;
    fit.figures.end_energy = [found] { return EndOf(found); };
    RemarkOnHeat(found, law.problem.gaps(), m, fit);
  }

  // structure in the residual
  if (law.unwhitened) {
    const Eigen::VectorXd friction = Kept(response.force, fit.rows.used);
    fit.causes.push_back(StructureCause(*law.unwhitened, friction, fit));
  }
  // the lag, which is not part of the model of law and heat
  if (law.lag) AddLag(law.lag, response.torque, m, fit);
  return fit;
}

std::vector<Unknown> HeatTable(const ThermalFit& warm, const std::vector<LogGap>& gaps,
                               const LogSamples& measurements) {
  const JointUnits units = UnitsOf(measurements);
  std::vector<Unknown> rows = HeatParameters(warm.thermal(), measurements);
  if (warm.estimates_initial_energy()) {
    rows.push_back(WithValue(StartUnknown(units), warm.initial_energy()));
  }
  // the jumps in the order of x
  const Eigen::VectorXd jumps = warm.jumps();
  const std::vector<std::string> names = JumpNames(gaps, measurements);
  for (size_t i = 0; i < names.size(); ++i) {
    rows.push_back(WithValue(JumpUnknown(names[i], units), jumps[static_cast<Eigen::Index>(i)]));
  }
  return rows;
}

void RemarkOnHeat(const ThermalFit& warm, const std::vector<LogGap>& gaps,
                  const LogSamples& measurements, Fit& fit) {
  std::vector<LogGap> within = gaps;
  std::erase_if(within, IsStart);
  if (!within.empty())
    fit.causes.push_back(Note(ExplainGaps(within, measurements.time, Action::note)));
  if (warm.initial.is_expected() && !measurements.further_starts.empty()) {
    fit.causes.push_back(Note(kOthersBeginCold));
  }
}

}  // namespace warmjoint
