#include "identification/warming/fit_law.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "identification/fit/fit_data.h"
#include "identification/fit/seen_samples.h"
#include "identification/inference/hausman_test.h"
#include "identification/lagged/lagged_fit.h"
#include "identification/linear/huber.h"
#include "identification/linear/rigid_part.h"
#include "identification/sentences/late_torque.h"
#include "identification/warming/gaps.h"
#include "identification/warming/initial_energy.h"
#include "identification/warming/law_fit.h"
#include "identification/warming/law_lag.h"
#include "identification/warming/load.h"
#include "identification/warming/torque_delay.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

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
  Fit fit = ConcludeLaw(std::move(law));
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

}  // namespace warmjoint
