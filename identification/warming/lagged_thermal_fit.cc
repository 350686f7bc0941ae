#include "identification/warming/lagged_thermal_fit.h"

#include <cmath>
#include <optional>

#include "identification/lagged/lagged_fit.h"
#include "identification/lagged/linear_lag.h"
#include "identification/linear/rigid_part.h"

namespace warmjoint {

namespace {

/// A start from the level of friction that is left where what a lag adds to law and offsets alone is taken off
/// the torque; nothing where that shows no lag.
std::optional<InitialGuess> StartBehindLag(const Measurements& m,
                                           const std::shared_ptr<const KeptRuns>& runs,
                                           const ClosedLoop& loop, const Eigen::MatrixXd& offsets,
                                           const StartFromLevel& scan) {
  const Eigen::MatrixXd columns =
      loop.direction().asDiagonal() * ConcatColumns(loop.levels(), offsets);
  const Eigen::MatrixXd A = columns(runs->samples, Eigen::all);
  const Eigen::VectorXd measured = m.torque(runs->samples);
  const auto found = FitLinearLag(runs, A, measured, {});
  if (!found) return std::nullopt;
  // without what the lag adds to the model the scan sees friction alone
  const Eigen::VectorXd model = A * found->fit.solution;
  Eigen::VectorXd torque = m.torque;
  torque(runs->samples) -= found->rows->FittedTo(measured, model) - model;
  return scan(loop.direction().cwiseProduct(torque));
}

}  // namespace

std::shared_ptr<const LaggedRows> FitWithTorqueLag(const Measurements& m, const Selection& moving,
                                                   const ClosedLoop& loop,
                                                   const Eigen::MatrixXd& offsets,
                                                   const Eigen::VectorXd& spread,
                                                   const StartFromLevel& scan, ThermalFit& fit) {
  const auto runs = std::make_shared<const KeptRuns>(FindRuns(m, moving));
  const Eigen::VectorXd measured = m.torque(runs->samples);
  const Eigen::VectorXd kept = moving.keep.cast<double>();
  const double scale = std::sqrt(fit.solution.squares / kept.sum());

  // [N]; empty where the friction feeds itself
  const auto torque_of = [&](const ThermalFit& one) -> Eigen::VectorXd {
    const LoopResponse response =
        loop.Simulate(one.parameters(), one.thermal(), one.initial_energy(), one.jump_values());
    if (response.feeds_itself) return {};
    return response.force + loop.direction().cwiseProduct(offsets * one.offset_values());
  };

  // each from where the latest ended; a fit without the lag may have gone astray
  ThermalFit latest = fit;
  InitialGuess start = StartFrom(fit);
  if (!fit.converged) {
    const auto behind = StartBehindLag(m, runs, loop, offsets, scan);
    if (!behind) return nullptr;
    start = *behind;
  }
  // law and warming at one lag, from the torque without it
  const auto fit_at = [&](const LaggedRows& rows) -> ModelBehindLag {
    Eigen::VectorXd level = Eigen::VectorXd::Zero(m.size());
    level(runs->samples) = rows.Unlagged(measured);
    level.array() *= loop.direction().array();
    ThermalFit next = FitThermalFriction(loop, level, offsets, kept, start, fit.initial, scale,
                                         JumpWeights(scale, spread), &rows);
    if (!next.converged) return {};
    const Eigen::VectorXd torque = torque_of(next);
    if (torque.size() == 0) return {};
    latest = std::move(next);
    start = StartFrom(latest);
    return {latest.solution.squares, torque(runs->samples)};
  };
  // what the search compares with: no lag at all
  Eigen::VectorXd without;
  if (const Eigen::VectorXd all = torque_of(fit); fit.converged && all.size() > 0) {
    without = all(runs->samples);
  }
  // the lag that leaves least, and the fit at it
  auto rows = SearchLag(runs, measured, without, fit_at);
  if (!rows || fit_at(*rows).torque.size() == 0) return nullptr;
  latest.trace.insert(latest.trace.begin(), fit.trace.begin(), fit.trace.end());
  fit = std::move(latest);
  return rows;
}

}  // namespace warmjoint
