#include "identification/inference/covariance.h"

#include <algorithm>

#include "identification/fit_data.h"

namespace warmjoint::inline identification {
namespace {

/// Of weighted squares: C (W J)^T R (W J) C with C = (J^T W J)^-1.
Uncertainty OfWeighted(const Eigen::MatrixXd& jacobian, const ErrorModel& errors,
                       const Eigen::VectorXd& residual, const Selection& used) {
  Uncertainty known;
  known.noise = FitNoise(residual, used);
  const Eigen::MatrixXd scatter =
      ScatterThrough(known.noise, errors.weights.asDiagonal() * jacobian, used);
  known.covariance = errors.cofactor * scatter * errors.cofactor;

  // as many samples as the weights leave
  const double sum = errors.weights.sum();
  const double effective = sum * sum / errors.weights.squaredNorm();
  known.freedom =
      std::max(effective / known.noise.redundancy - static_cast<double>(jacobian.cols()), 1.0);
  return known;
}

}  // namespace

Uncertainty CovarianceOf(const Fit& fit) {
  const ErrorModel& errors = fit.errors;
  if (errors.known) return *errors.known;
  const Eigen::VectorXd residual = errors.scores.size() > 0 ? errors.scores : fit.residual();
  const auto jacobian = [&] { return Kept(fit.jacobian(), fit.used); };
  if (errors.weights.size() > 0) return OfWeighted(jacobian(), errors, residual, fit.used);

  return JudgeUncertainty(jacobian, errors.cofactor, residual, fit.used, fit.fitted, errors.prior);
}

}  // namespace warmjoint::inline identification
