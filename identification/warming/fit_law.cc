#include "identification/warming/fit_law.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "identification/fit/fit_data.h"
#include "identification/fit/fit_parameters.h"
#include "identification/fit/seen_samples.h"
#include "identification/inference/hausman_test.h"
#include "identification/lagged/lagged_fit.h"
#include "identification/linear/huber.h"
#include "identification/linear/rigid_part.h"
#include "identification/sentences/fit.h"
#include "identification/sentences/friction.h"
#include "identification/sentences/heat.h"
#include "identification/sentences/late_torque.h"
#include "identification/uncertainty/few_segments.h"
#include "identification/uncertainty/tails.h"
#include "identification/warming/gaps.h"
#include "identification/warming/initial_energy.h"
#include "identification/warming/law_problem.h"
#include "identification/warming/load.h"
#include "identification/warming/torque_delay.h"
#include "identification/warming/warming_verdict.h"
#include "models/foundation/robust_noise.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

/// The state of a fit from its first pass, by plain squares, to its last.
struct LawFit {
  std::string name;
  LawProblem problem;
  RowTreatment rows;
  ThermalFit fit;
  double nominal_squares = 0;    // that the law leaves without heat, on the same rows
  InitialGuess scanned{};        // where a fit with heat began
  double threshold = kInfinity;  // N.m or N, from which on Huber's loss is linear
  std::shared_ptr<const LaggedRows> lag{};
  std::shared_ptr<const Whitening> whitening{};
  std::optional<Disagreement> unwhitened{};  // why coloured rows were not whitened

  const IdentifierInput& input() const { return problem.input(); }
  const LogSamples& measurements() const { return problem.input().measurements; }
  /// Takes over a pass, and the squares that the law leaves on its rows without heat.
  void Take(RowTreatment treatment, ThermalFit next) {
    rows = std::move(treatment);
    fit = std::move(next);
    nominal_squares = fit.has_heat() ? problem.FitCold(rows).squares : fit.squares;
  }
};

/// Adds the heat by plain squares, with what is known of E(0) and a jump of E at each gap. Returns the clause that the
/// log contradicts the start that was expected; or an empty text.
std::string AddHeat(LawFit& law) {
  // first without gaps, with E(0) as the options have it: where it is estimated, so is that of each further recording
  LawProblem& problem = law.problem;
  const InitialEnergy initial = InitialEnergyOf(law.input().options);
  const std::vector<LogGap> starts = FreeStarts(initial, law.measurements(), law.input().selection);
  problem.TakeJumps(starts, JumpSpread(starts, 0, 1));
  law.scanned = problem.Scan(law.measurements().torque, law.fit);
  law.rows.scale = std::sqrt(law.nominal_squares / static_cast<double>(law.rows.torque.size()));
  law.fit = problem.FitWarm(law.rows, initial, law.scanned);

  // what was known of E(0), weighed by the noise that this fit leaves
  const ThermalRows rows = problem.WarmRows(law.fit.initial, law.rows.scale);
  const std::string contradiction = RefitStart(
      rows,
      [&](const ThermalFit& alone) {
        const Eigen::VectorXd left =
            law.rows.torque - Kept(problem.Respond(alone).torque, law.input().selection);
        return problem.CovarianceOf(alone, left).Deviation(alone.At(Role::start).begin);
      },
      law.fit);

  // the losses within gaps are not known: E may jump there
  const std::vector<LogGap> gaps = FindGaps(law.measurements());
  if (!gaps.empty()) {
    const std::vector<LogGap> all = Merged(gaps, starts);
    const Eigen::VectorXd spread = FitJumps(rows, all, law.scanned, law.fit);
    problem.TakeJumps(all, spread);
  }
  law.rows.scale = std::sqrt(law.fit.squares / static_cast<double>(law.rows.torque.size()));
  return contradiction;
}

constexpr int kMostHuberRounds = 100;
constexpr double kHuberConverged =
    1e-6;  // of each parameter between rounds, in standard deviations

/// Whether no parameter changed by more than a share of its standard deviation.
bool HasConverged(const ThermalFit& before, const ThermalFit& after, double scale) {
  const Eigen::ArrayXd deviations = scale * after.cofactor.diagonal().array().sqrt();
  return ((after.x - before.x).array().abs() <= kHuberConverged * deviations).all();
}

/// Fits repeatedly, each sample weighted by Huber's loss of its residual in the fit before (least_squares.h),
/// until the parameters no longer change; `converged` says whether that was reached.
void RefineByHuber(LawFit& law) {
  law.threshold = 0;
  ThermalFit fit = law.fit;
  RowTreatment rows = law.rows;
  bool rests = false;
  for (int round = 0; round < kMostHuberRounds && fit.converged && !rests; ++round) {
    // weights by how far the residual exceeds its robust spread
    const Eigen::VectorXd residual =
        rows.torque - Kept(law.problem.Respond(fit).torque, law.input().selection);
    if (!residual.allFinite()) break;
    law.threshold = HuberThreshold(residual);
    if (!(law.threshold > 0)) break;
    rows.weights = HuberWeights(residual, law.threshold);
    rows.scale = law.threshold / kHuberBend;

    // from where the fit before ended
    ThermalFit next = law.problem.FitAgain(rows, fit);
    rests = next.converged && HasConverged(fit, next, rows.scale);
    fit = std::move(next);
  }
  // exact data leave no residual to which Huber's loss could apply
  fit.converged = fit.converged && (rests || !(law.threshold > 0));
  law.Take(std::move(rows), std::move(fit));
}

/// Fits once more on whitened rows, where the noise is coloured beyond doubt. The fit stays as it was
/// where whitening changes it by more than noise may.
void Whiten(LawFit& law) {
  const ThermalFit& plain = law.fit;
  const ThermalResponse response = law.problem.Respond(plain);
  if (!plain.converged || response.first_driving) return;
  // what the fit leaves, and the noise in it
  const Selection& selection = law.input().selection;
  const Eigen::VectorXd left = law.rows.torque - Kept(response.torque, selection);
  auto whitening = WhiteningFor(left, law.measurements(), selection);
  if (!whitening) return;

  // the same fit by whitened rows
  const double innovation = whitening->noise().innovation;
  RowTreatment rows{
      .torque = law.rows.torque, .transform = whitening, .scale = std::sqrt(innovation)};
  ThermalFit white = law.problem.FitAgain(rows, plain);
  if (!white.converged) return;

  // back to the plain fit where whitening changes too much
  const Uncertainty uncertainty = law.problem.CovarianceOf(plain, left);
  law.unwhitened =
      FindDisagreement({plain.x, uncertainty.covariance}, {white.x, innovation * white.cofactor},
                       uncertainty.degrees_of_freedom);
  if (law.unwhitened) return;
  law.whitening = std::move(whitening);
  law.Take(std::move(rows), std::move(white));
}

/// A fit at one lag, of the search for the best.
struct FitAtOneLag {
  std::shared_ptr<const LaggedRows> lag;
  RowTreatment rows;
  ThermalFit fit;
};

/// The best lag (SearchLag), and the fit at it; nothing where the log shows no lag. start: of the first trial with heat,
/// none without heat; without: [n] torque of the fit without a lag, empty where that did not converge to a friction
std::optional<FitAtOneLag> FitAtBestLag(const LawFit& law, std::optional<InitialGuess> start,
                                        const Eigen::VectorXd& without) {
  const Selection& selection = law.input().selection;
  const Eigen::VectorXd measured = Kept(law.measurements().torque, selection);
  const auto runs = std::make_shared<const KeptRuns>(FindRuns(law.measurements(), selection));
  FitAtOneLag latest;
  const auto fit_at = [&](const LaggedRows& at) -> LaggedModel {
    latest = {};
    RowTreatment rows{.torque = at.BeforeLag(measured),
                      .transform = {std::shared_ptr<void>(), &at},
                      .scale = law.rows.scale};
    ThermalFit next =
        start ? law.problem.FitWarm(rows, law.fit.initial, *start) : law.problem.FitCold(rows);
    if (!next.converged) return {};
    const ThermalResponse response = law.problem.Respond(next);
    if (response.first_driving) return {};
    // each trial begins where the latest ended
    if (start) start = StartFrom(next);
    latest = {nullptr, std::move(rows), std::move(next)};
    return {latest.fit.squares, Kept(response.torque, selection)};
  };
  const auto refine = [&](const RowsOfLag& rows_of, double at, const LagBracket& bracket) {
    const ThermalFit& fit = latest.fit;
    return RefineLag(*fit.model, fit.x, law.problem.SamplesFor(law.problem.AsMeasured()),
                     law.rows.scale * law.rows.scale, rows_of, at, bracket);
  };
  auto lag = SearchLag(runs, measured, without, {fit_at, refine});
  if (!lag || fit_at(*lag).torque.size() == 0) return std::nullopt;
  latest.rows.transform = latest.lag = std::move(lag);
  return latest;
}

/// The start of a search for the lag where the fit without one failed: it is found from the torque less what the lag of a law
/// without heat adds. Nothing where the law without heat shows no lag.
std::optional<InitialGuess> StartWithLag(const LawFit& law) {
  const auto found = FitAtBestLag(law, std::nullopt, {});
  if (!found) return std::nullopt;
  // without what the lag adds to the model, the scan is over friction only
  const Selection& selection = law.input().selection;
  Eigen::VectorXd torque = law.measurements().torque;
  const Eigen::VectorXd model = Kept(law.problem.Respond(found->fit).torque, selection);
  torque(found->lag->runs()->samples) -=
      found->lag->FittedTo(Kept(torque, selection), model) - model;
  return law.problem.Scan(torque, law.problem.FitCold(law.problem.AsMeasured()));
}

/// Fits once more with the lag of the torque that leaves the least squares, where the log shows a lag. Losses follow
/// from the friction itself, which no lag touches.
void AddTorqueLag(LawFit& law) {
  // what the search compares with: no lag at all
  std::optional<InitialGuess> start;
  Eigen::VectorXd without;
  if (law.fit.converged) {
    const ThermalResponse response = law.problem.Respond(law.fit);
    if (!response.first_driving) without = Kept(response.torque, law.input().selection);
    if (law.fit.has_heat()) start = StartFrom(law.fit);
  } else {
    start = StartWithLag(law);
    if (!start) return;
  }
  auto found = FitAtBestLag(law, std::move(start), without);
  if (!found) return;
  found->fit.Follow(law.fit);
  law.lag = std::move(found->lag);
  law.Take(std::move(found->rows), std::move(found->fit));
}

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

/// The result of the fit, or why it is refused.
Fit Conclude(LawFit law) {
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

/// The fit to a torque that follows its motion at once, or with a first-order lag.
Fit FitLawInTime(const std::string& name, const IdentifierInput& given, PartFit heat) {
  const bool warms = heat == PartFit::estimated;
  const LinearTask task = BeginLinear(given, warms ? 3 : 0);
  if (task.refusal) return Refused(name, *task.refusal);
  const IdentifierInput chosen = task.gravity.Of(given);
  const Selection moving = WithoutRest(chosen.selection, chosen.measurements);
  const IdentifierInput input = chosen.With(moving);

  // the columns of law and gravity must be distinct before a warming is fitted
  LawProblem problem(input, task);
  const RowTreatment measured = problem.AsMeasured();
  ThermalFit cold = problem.FitCold(measured);
  if (!cold.converged) {
    return Refused(name, IndistinctColumns(cold.mixed, task, input));
  }
  LawFit law{.name = name, .problem = std::move(problem), .rows = measured, .fit = std::move(cold)};
  law.nominal_squares = law.fit.squares;
  const std::string contradiction = warms ? AddHeat(law) : "";

  // with a lag; else by the passes that outliers and the colour of the noise ask for
  if (AsksForLag(input.options)) AddTorqueLag(law);
  if (!law.lag) {
    if (input.options.OrDefault<LossOption>().loss == LossKind::huber) {
      RefineByHuber(law);
    } else {
      Whiten(law);
    }
  }
  const bool lacks_lag = AsksForLag(input.options) && !law.lag;
  Fit fit = Conclude(std::move(law));
  if (lacks_lag) fit.causes.push_back(Note(kNoLagSeen, SentenceIn::message));
  if (!contradiction.empty()) fit.causes.push_back(Note(contradiction));
  return fit;
}

}  // namespace

Fit FitLaw(const std::string& name, const IdentifierInput& given, PartFit heat) {
  if (auto why = WhyNoLag(given)) return Refused(name, Status::bad_data, *why);
  if (auto why = WhyNoLoad(given)) return Refused(name, Status::bad_data, *why);
  const auto under = [&](const IdentifierInput& one) { return FitLawInTime(name, one, heat); };
  const auto in_time = [&](const IdentifierInput& one) { return FitUnderLoad(one, under); };
  return MayBeLate(given) ? FitBehindDelay(given, in_time) : in_time(given);
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
