#include "identification/warming/law_lag.h"

#include <memory>
#include <optional>
#include <utility>

#include "identification/fit/fit_data.h"
#include "identification/lagged/lagged_fit.h"

namespace warmjoint {
namespace {

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

}  // namespace

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

}  // namespace warmjoint
