#include "tools/report/run/median_bound.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <vector>

#include "models/foundation/random_stream.h"

namespace warmjoint::report {

double MedianNormOf(const Eigen::MatrixXd& covariance) {
  constexpr std::size_t kDraws = 20001;
  // errors at the bound are normal with this covariance
  const Eigen::MatrixXd root = covariance.llt().matrixL();
  RandomStream random({1, 0}, Stream::truth);
  std::vector<double> norms(kDraws);
  Eigen::VectorXd draw(covariance.rows());
  // the median of their norms has no formula and is drawn
  for (double& norm : norms) {
    for (double& value : draw) value = random.Normal();
    norm = (root * draw).norm();
  }
  std::nth_element(norms.begin(), norms.begin() + kDraws / 2, norms.end());
  return norms[kDraws / 2];
}

}  // namespace warmjoint::report
