#include "identification/score/npe.h"

namespace warmjoint::inline identification {

double NormalisedParameterError(const Eigen::VectorXd& estimate, const Eigen::VectorXd& truth) {
  return ((estimate - truth).array() / truth.array().abs()).matrix().norm();
}

}  // namespace warmjoint::inline identification
