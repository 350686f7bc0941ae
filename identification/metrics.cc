#include "identification/metrics.h"

#include <cmath>
#include <limits>

namespace warmjoint::inline identification {

Metrics ComputeMetrics(const Eigen::VectorXd& measured, const Eigen::VectorXd& fitted,
                       int parameters, double effective_parameters) {
  const double n = static_cast<double>(measured.size());
  // the residual, and what a constant torque would leave
  const Eigen::VectorXd error = measured - fitted;
  const double mean_square = error.squaredNorm() / n;
  const double spread = (measured.array() - measured.mean()).matrix().norm();

  Metrics metrics;
  metrics.n = static_cast<int>(measured.size());
  metrics.parameters = parameters;
  metrics.effective_parameters = effective_parameters;
  metrics.rmse = std::sqrt(mean_square);
  metrics.mae = error.cwiseAbs().mean();
  // neither a constant torque has a share to explain, nor a fit with no sample to spare an error to predict
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  metrics.fit = spread > 0 ? 100 * (1 - error.norm() / spread) : none;
  metrics.fpe = parameters < n ? mean_square * (1 + parameters / n) / (1 - parameters / n) : none;
  return metrics;
}

}  // namespace warmjoint::inline identification
