#include "identification/uncertainty/penalised_uncertainty.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace warmjoint::inline identification {

Uncertainty JudgePenalised(
    const PenalisedFit& fit,
    const std::function<Eigen::MatrixXd(Eigen::Index first, Eigen::Index last)>& rows,
    const Eigen::VectorXd& residual, const Selection& selection) {
  const Eigen::MatrixXd& C = fit.inverse;
  const auto n = static_cast<double>(residual.size());
  const Eigen::Index q = fit.weights.size();
  Uncertainty result;
  result.noise = FitNoise(residual, selection);
  const NoiseModel& noise = result.noise;

  // E|r|^2 = tr R - 2 tr(C S) + tr(C G C S), in samples of which at most half are taken up
  const Eigen::MatrixXd hat = C * fit.gram;
  const Eigen::MatrixXd spread =
      noise.order() == 0 ? Eigen::MatrixXd(noise.variance * hat)
                         : Eigen::MatrixXd(C * ScatterThrough(noise, rows, C.rows(), selection));
  const double product = hat.cwiseProduct(spread.transpose()).sum();
  const double taken = std::clamp((2 * spread.trace() - product) / noise.variance, 0.0, 0.5 * n);
  Eigen::MatrixXd by_noise(C.rows(), C.rows());
  by_noise.triangularView<Eigen::Lower>() = n / (n - taken) * spread * C;
  by_noise.triangularView<Eigen::StrictlyUpper>() = by_noise.transpose();

  // what the prior pulls away
  const Eigen::MatrixXd pull = fit.strength * C.middleCols(fit.first, q);
  const Eigen::MatrixXd left = Eigen::MatrixXd::Identity(q, q) - pull.middleRows(fit.first, q);
  const auto weights = by_noise.block(fit.first, fit.first, q, q);
  const double seen = fit.weights.squaredNorm() - weights.trace();
  const double unseen = std::sqrt(2.0) * weights.norm();
  const double prior = std::max(seen, unseen) / std::max(left.squaredNorm(), 1e-12);
  by_noise.selfadjointView<Eigen::Lower>().rankUpdate(pull, prior);
  by_noise.triangularView<Eigen::StrictlyUpper>() = by_noise.transpose();
  if (fit.prior.size() > 0) {
    by_noise += noise.variance * (C * fit.prior.asDiagonal() * C);
  }
  result.covariance = std::move(by_noise);
  result.freedom = std::max(n / noise.redundancy - hat.trace(), 1.0);
  return result;
}

}  // namespace warmjoint::inline identification
