#include "tools/report/run/median_bound.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <vector>

#include "models/foundation/random_stream.h"

namespace warmjoint::report {

double MedianNormOf(const Eigen::MatrixXd& covariance) {
  constexpr std::size_t kDraws = 20001;
  const Eigen::MatrixXd root = covariance.llt().matrixL();
  RandomStream random({1, 0}, Stream::truth);
  std::vector<double> norms(kDraws);
  Eigen::VectorXd draw(covariance.rows());
  for (double& norm : norms) {
    for (double& value : draw) value = random.Normal();
    norm = (root * draw).norm();
  }
  std::nth_element(norms.begin(), norms.begin() + kDraws / 2, norms.end());
  return norms[kDraws / 2];
}

}  // namespace warmjoint::report
