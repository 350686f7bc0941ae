#include "identification/inference/covariance.h"

#include <algorithm>

#include "identification/fit_data.h"
#include "identification/uncertainty/few_segments.h"

namespace warmjoint {
namespace {

/// Of weighted squares: C (W J)^T R (W J) C with C = (J^T W J)^-1.
Uncertainty OfWeighted(const Eigen::MatrixXd& jacobian, const ErrorModel& errors,
                       const Eigen::VectorXd& residual, const Selection& used) {
  Uncertainty known;
  known.noise = FitNoise(residual, used);
  const Eigen::MatrixXd scatter =
      ScatterThrough(known.noise, errors.weights.asDiagonal() * jacobian, used);
  known.covariance = errors.cofactor * scatter * errors.cofactor;
  known.degrees_of_freedom =
      DegreesOfFreedomOfWeights(errors.weights, known.noise, jacobian.cols());
  return known;
}

/// Of least squares with a Jacobian J that is formed where it is needed.
Uncertainty OfSquares(const Fit& fit, const Eigen::VectorXd& residual,
                      const std::function<Eigen::MatrixXd()>& rows) {
  const ErrorModel& errors = fit.errors;
  // an exact log: its numbers are as sure as the rounding of doubles lets them be
  if (IsRounding(residual.squaredNorm(), fit.torque)) {
    Uncertainty exact;
    exact.noise.variance = exact.noise.innovation = RoundingVariance(fit.torque);
    exact.covariance = exact.noise.variance * errors.cofactor;
    exact.degrees_of_freedom =
        std::max(static_cast<double>(residual.size() - errors.cofactor.rows()), 1.0);
    return exact;
  }
  Uncertainty known =
      EstimateCovariance(rows, errors.cofactor, residual, fit.used, fit.fitted, errors.prior);
  const bool has_prior = errors.prior.size() > 0 && !errors.prior.isZero();
  if (!has_prior && HasFewSegments(fit.used, errors.cofactor.rows())) {
    CountSegments(rows(), errors.cofactor, residual, fit.used, known);
  }
  return known;
}

/// Of whitened rows: what colour is left of them counts, too. The degrees of freedom are those of noise of the
/// colour that was taken off, since from the same samples that colour is known.
Uncertainty OfWhitened(const Fit& fit, const Whitening& whitening) {
  const auto rows = [&] { return whitening.Of(Kept(fit.jacobian(), fit.used)); };
  Uncertainty known = OfSquares(fit, whitening.Of(fit.residual()).col(0), rows);
  known.noise = whitening.noise();
  const auto samples = static_cast<double>(whitening.size());
  const auto count = static_cast<double>(fit.errors.cofactor.rows());
  known.degrees_of_freedom = std::min(
      known.degrees_of_freedom, std::max(samples / known.noise.variance_inflation - count, 1.0));
  return known;
}

/// By the noise of the residual.
Uncertainty ByNoise(const Fit& fit) {
  const ErrorModel& errors = fit.errors;
  // what the identifier knew already, or finds only where it is asked
  if (errors.known) return *errors.known;
  if (errors.judge) return errors.judge();

  // rows that were whitened are judged by the colour that is left
  if (errors.whitening) return OfWhitened(fit, *errors.whitening);

  // a robust loss or a lag brings scores in place of the residual
  const Eigen::VectorXd residual = errors.scores.size() > 0 ? errors.scores : fit.residual();
  const auto jacobian = [&] { return Kept(fit.jacobian(), fit.used); };
  if (errors.weights.size() > 0) return OfWeighted(jacobian(), errors, residual, fit.used);

  return OfSquares(fit, residual, jacobian);
}

}  // namespace

Uncertainty CovarianceOf(const Fit& fit) {
  Uncertainty known = ByNoise(fit);
  // structure that moves the friction little joins the errors as one more of them
  const Eigen::VectorXd& structure = fit.errors.structure;
  if (structure.size() > 0) known.covariance += structure * structure.transpose();
  return known;
}

double DegreesOfFreedomOfWeights(const Eigen::VectorXd& weights, const NoiseModel& noise,
                                 Eigen::Index d) {
  const double sum = weights.sum();
  const double effective = sum * sum / weights.squaredNorm();
  return std::max(effective / noise.variance_inflation - static_cast<double>(d), 1.0);
}

}  // namespace warmjoint
