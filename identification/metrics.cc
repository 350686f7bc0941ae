#include <cmath>

#include "identification/estimate.h"

namespace warmjoint::inline identification {

Metrics ComputeMetrics(const Eigen::VectorXd& measured, const Eigen::VectorXd& fitted,
                       int parameters, double effective_parameters) {
  const double n = static_cast<double>(measured.size());
  const Eigen::VectorXd error = measured - fitted;
  const double mean_square = error.squaredNorm() / n;
  const double spread = (measured.array() - measured.mean()).matrix().norm();

  Metrics metrics;
  metrics.n = static_cast<int>(measured.size());
  metrics.parameters = parameters;
  metrics.effective_parameters = effective_parameters;
  metrics.rmse = std::sqrt(mean_square);
  metrics.mae = error.cwiseAbs().mean();
  metrics.fit = 100 * (1 - error.norm() / spread);
  metrics.fpe = mean_square * (1 + parameters / n) / (1 - parameters / n);
  return metrics;
}

}  // namespace warmjoint::inline identification
