#include "identification/uncertainty/penalised_uncertainty.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace warmjoint {
namespace {

using Eigen::Index;

/// Places in x of the weights that are drawn from the prior.
std::vector<Index> Drawn(const PenalisedFit& fit) {
  std::vector<Index> drawn;
  for (Index k = 0; k < fit.weights.size(); ++k) {
    if (!fit.unseen[static_cast<size_t>(k)]) drawn.push_back(fit.first + k);
  }
  return drawn;
}

/// Covariance of those weights before any data, s_w^2 R. drawn: [q] their places in x; hat: [d x d] C G;
/// pull: [d x q] s C_w; by_noise: [d x d] covariance from the noise.
Eigen::MatrixXd BeforeData(const PenalisedFit& fit, const std::vector<Index>& drawn,
                           const Eigen::MatrixXd& hat, const Eigen::MatrixXd& pull,
                           const Eigen::MatrixXd& by_noise) {
  Eigen::VectorXd found(pull.cols());
  for (Index k = 0; k < found.size(); ++k) {
    found[k] = fit.weights[drawn[static_cast<size_t>(k)] - fit.first];
  }
  const Eigen::MatrixXd bias = pull.transpose() * fit.gram * pull;
  const Eigen::MatrixXd left = hat(drawn, drawn), noise = by_noise(drawn, drawn);
  return PriorOfWeights({found, left, bias, noise}, fit.correlation);
}

}  // namespace

Uncertainty PenalisedCovariance(
    const PenalisedFit& fit,
    const std::function<Eigen::MatrixXd(Eigen::Index first, Eigen::Index last)>& rows,
    const Eigen::VectorXd& residual, const Selection& selection) {
  const Eigen::MatrixXd& C = fit.inverse;
  const auto n = static_cast<double>(residual.size());
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
  const std::vector<Index> drawn = Drawn(fit);
  const Eigen::MatrixXd pull = fit.strength * C(Eigen::all, drawn);
  const Eigen::MatrixXd by_pull = pull * BeforeData(fit, drawn, hat, pull, by_noise);
  by_noise.triangularView<Eigen::Lower>() += by_pull * pull.transpose();
  by_noise.triangularView<Eigen::StrictlyUpper>() = by_noise.transpose();
  // what was known beforehand errs as a measurement of that weight does
  if (fit.prior.size() > 0) {
    by_noise += noise.variance * (C * fit.prior.asDiagonal() * C);
  }
  result.covariance = std::move(by_noise);
  // independent samples less effective parameters
  result.freedom = std::max(n / noise.variance_inflation - hat.trace(), 1.0);
  return result;
}

}  // namespace warmjoint
