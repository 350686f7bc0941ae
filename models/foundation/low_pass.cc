#include "models/foundation/low_pass.h"

#include <cmath>

namespace warmjoint::inline models {

double ShareFollowed(double step, double time_constant) {
  return -std::expm1(-step / time_constant);
}

Eigen::VectorXd LowPass(const Eigen::VectorXd& time, const Eigen::VectorXd& x,
                        double time_constant) {
  Eigen::VectorXd filtered = x;
  for (Eigen::Index i = 1; i < x.size(); ++i) {
    // towards the sample before, held until this one
    const double share = ShareFollowed(time[i] - time[i - 1], time_constant);
    filtered[i] = filtered[i - 1] + share * (x[i - 1] - filtered[i - 1]);
  }
  return filtered;
}

}  // namespace warmjoint::inline models
