#include "identification/warming/robust_thermal_fit.h"

#include <cmath>

#include "identification/linear/robust.h"

namespace warmjoint {
namespace {

constexpr int kMostRounds = 100;
constexpr double kConverged = 1e-4;  // of each parameter between rounds, relative to its deviation

/// Residuals of the level, 0 where a sample is not kept. [N]
Eigen::VectorXd Residual(const ClosedLoop& loop, const Eigen::VectorXd& level,
                         const Eigen::MatrixXd& offsets, const Eigen::VectorXd& kept,
                         const ThermalFit& fit) {
  const LoopResponse response =
      loop.Simulate(fit.parameters(), fit.thermal(), fit.initial_energy(), fit.jump_values());
  const Eigen::VectorXd modelled = loop.direction().cwiseProduct(response.force);
  return (kept.array() > 0).select(level - modelled - offsets * fit.offset_values(), 0);
}

/// The residuals of kept samples alone. [n]
Eigen::VectorXd OfKept(const Eigen::VectorXd& residual, const Eigen::VectorXd& kept) {
  Eigen::VectorXd some(static_cast<Eigen::Index>((kept.array() > 0).count()));
  Eigen::Index n = 0;
  for (Eigen::Index i = 0; i < kept.size(); ++i) {
    if (kept[i] > 0) some[n++] = residual[i];
  }
  return some;
}

/// Whether no parameter moved by more than a share of its standard deviation.
bool HasConverged(const ThermalFit& before, const ThermalFit& after, double threshold) {
  const Eigen::ArrayXd scale = after.normal.diagonal().array().sqrt();
  return ((after.solution.x - before.solution.x).array().abs() * scale <= kConverged * threshold)
      .all();
}

}  // namespace

RobustThermalFit RefineByHuber(const ClosedLoop& loop, const Eigen::VectorXd& level,
                               const Eigen::MatrixXd& offsets, const Eigen::VectorXd& kept,
                               ThermalFit fit, const Eigen::VectorXd& spread) {
  RobustThermalFit robust{std::move(fit), kept, 0};
  bool rests = false;
  for (int round = 0; round < kMostRounds && robust.fit.converged && !rests; ++round) {
    // weights by how far the residual stands out of its robust spread
    const Eigen::VectorXd residual = Residual(loop, level, offsets, kept, robust.fit);
    if (!residual.allFinite()) break;
    robust.threshold = HuberThreshold(OfKept(residual, kept));
    if (!(robust.threshold > 0)) break;
    robust.weight = kept.cwiseProduct(HuberWeights(residual, robust.threshold));

    // from where the fit before ended
    ThermalFit next = FitThermalFriction(loop, level, offsets, robust.weight, StartFrom(robust.fit),
                                         robust.fit.initial, robust.threshold / kHuberBend,
                                         JumpWeights(robust.threshold / kHuberBend, spread));
    rests = HasConverged(robust.fit, next, robust.threshold);
    next.trace.insert(next.trace.begin(), robust.fit.trace.begin(), robust.fit.trace.end());
    robust.fit = std::move(next);
  }

  // the fit of exact data has no residual that could bend the loss
  robust.fit.converged = robust.fit.converged && (rests || !(robust.threshold > 0));
  return robust;
}

}  // namespace warmjoint
