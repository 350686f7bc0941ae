#include "identification/warming/lagged_warm_fit.h"

#include <cmath>

#include "identification/lagged/lagged_fit.h"

namespace warmjoint::inline identification {

std::shared_ptr<const LaggedRows> FitBehindLag(const Measurements& m, const Selection& moving,
                                               const ClosedLoop& loop,
                                               const Eigen::MatrixXd& offsets,
                                               const Eigen::VectorXd& spread, WarmFit& fit) {
  const auto runs = std::make_shared<const KeptRuns>(FindRuns(m, moving));
  const Eigen::VectorXd measured = m.torque(runs->samples);
  const Eigen::VectorXd kept = moving.keep.cast<double>();
  const double scale = std::sqrt(fit.solution.squares / kept.sum());

  // each from where the latest ended
  WarmFit latest = fit;
  const auto fit_at = [&](const LaggedRows& rows) -> ModelBehindLag {
    Eigen::VectorXd level = Eigen::VectorXd::Zero(m.size());
    level(runs->samples) = rows.Unlagged(measured);
    level.array() *= loop.direction().array();
    WarmFit next = FitWarmFriction(loop, level, offsets, kept, StartFrom(latest), fit.initial,
                                   scale, JumpWeights(scale, spread), &rows);
    if (!next.converged) return {};
    const LoopResponse response =
        loop.Simulate(next.parameters(), next.thermal(), next.initial_energy(), next.jump_values());
    if (response.feeds_itself) return {};
    latest = std::move(next);
    const Eigen::VectorXd beside = offsets * latest.offset_values();
    return {latest.solution.squares, response.force + loop.direction().cwiseProduct(beside)};
  };
  const LoopResponse before =
      loop.Simulate(fit.parameters(), fit.thermal(), fit.initial_energy(), fit.jump_values());
  const Eigen::VectorXd without =
      before.force + loop.direction().cwiseProduct(offsets * fit.offset_values());
  auto rows = SearchLag(runs, measured, Eigen::VectorXd(without(runs->samples)), fit_at);
  if (!rows || fit_at(*rows).torque.size() == 0) return nullptr;
  latest.trace.insert(latest.trace.begin(), fit.trace.begin(), fit.trace.end());
  fit = std::move(latest);
  return rows;
}

}  // namespace warmjoint::inline identification
