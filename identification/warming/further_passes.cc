#include "identification/warming/further_passes.h"

#include <cmath>

#include "identification/fit_data.h"

namespace warmjoint::inline identification {

Eigen::VectorXd FitJumps(const ClosedLoop& loop, const Eigen::VectorXd& level,
                         const Eigen::MatrixXd& offsets, const Eigen::VectorXd& kept,
                         const std::vector<LogGap>& gaps, WarmFit& fit) {
  const Thermal thermal = fit.thermal();
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(gaps.size()));
  const LoopResponse response =
      loop.Simulate(fit.parameters(), thermal, fit.initial_energy(), none);
  const Eigen::VectorXd spread =
      JumpSpread(gaps, response.energy.cwiseAbs().maxCoeff(), thermal.time_constant);
  const double scale = std::sqrt(fit.solution.squares / kept.sum());
  WarmFit next = FitWarmFriction(loop, level, offsets, kept, StartFrom(fit), fit.initial, scale,
                                 JumpWeights(scale, spread));
  next.trace.insert(next.trace.begin(), fit.trace.begin(), fit.trace.end());
  fit = std::move(next);
  return spread;
}

std::shared_ptr<const Whitening> FitWhitened(const Measurements& m, const Selection& moving,
                                             const ClosedLoop& loop, const Eigen::VectorXd& level,
                                             const Eigen::MatrixXd& offsets,
                                             const Eigen::VectorXd& spread, WarmFit& fit) {
  if (!fit.converged) return nullptr;
  const LoopResponse response =
      loop.Simulate(fit.parameters(), fit.thermal(), fit.initial_energy(), fit.jump_values());
  if (response.feeds_itself) return nullptr;
  const Eigen::VectorXd left =
      loop.direction().cwiseProduct(level - offsets * fit.offset_values()) - response.force;
  auto whitening = WhiteningFor(Kept(left, moving), m, moving);
  if (!whitening) return nullptr;

  const double scale = std::sqrt(whitening->noise().innovation);
  WarmFit next = FitWarmFriction(loop, level, offsets, moving.keep.cast<double>(), StartFrom(fit),
                                 fit.initial, scale, JumpWeights(scale, spread), whitening.get());
  if (!next.converged) return nullptr;
  next.trace.insert(next.trace.begin(), fit.trace.begin(), fit.trace.end());
  fit = std::move(next);
  return whitening;
}

}  // namespace warmjoint::inline identification
