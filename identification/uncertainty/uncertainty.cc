#include "identification/uncertainty/uncertainty.h"

#include <fmt/format.h>

#include <algorithm>

namespace warmjoint {

Uncertainty JudgeUncertainty(const Eigen::MatrixXd& jacobian, const Eigen::MatrixXd& cofactor,
                             const Eigen::VectorXd& residual, const Selection& selection) {
  return JudgeUncertainty([&] { return jacobian; }, cofactor, residual, selection);
}

Uncertainty JudgeUncertainty(const std::function<Eigen::MatrixXd()>& jacobian,
                             const Eigen::MatrixXd& cofactor, const Eigen::VectorXd& residual,
                             const Selection& selection) {
  Uncertainty result;
  result.noise = FitNoise(residual, selection);
  const NoiseModel& noise = result.noise;
  const auto n = static_cast<double>(residual.size());
  const auto d = static_cast<double>(cofactor.rows());

  // white: (J^T R J) C is s^2 times the identity
  if (noise.order() == 0) {
    result.freedom = n - d;
    result.covariance = residual.squaredNorm() / result.freedom * cofactor;
    return result;
  }

  // coloured: what the fit took up counts in samples, at most half of them
  const Eigen::MatrixXd scatter = ScatterThrough(noise, jacobian(), selection);
  const double taken = std::min((cofactor * scatter).trace() / noise.variance, 0.5 * n);
  result.freedom = std::max(n / noise.redundancy - d, 1.0);
  result.covariance = n / (n - taken) * cofactor * scatter * cofactor;
  return result;
}

std::string ColourOf(const NoiseModel& noise) {
  if (noise.order() == 0) return "";
  return fmt::format(
      "; noise is coloured (correlation {:.2f} between neighbours), which the intervals account "
      "for",
      noise.correlation);
}

}  // namespace warmjoint
