#include "identification/linear/huber.h"

#include <cmath>

#include "identification/sentences/fit.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

constexpr double kNormal = 1.4826;  // why: standard deviation over median size of normal noise
constexpr double kFarResidual = 4;  // standard deviations: one normal sample in 16 000

}  // namespace

double HuberThreshold(const Eigen::VectorXd& residual) {
  Eigen::VectorXd size = residual.cwiseAbs();
  return kHuberBend * kNormal * MedianInPlace(size);
}

Eigen::VectorXd HuberWeights(const Eigen::VectorXd& residual, double threshold) {
  return residual.unaryExpr(
      [threshold](double r) { return std::abs(r) <= threshold ? 1 : threshold / std::abs(r); });
}

Eigen::VectorXd HuberScores(const Eigen::VectorXd& residual, double threshold) {
  // mean slope of psi: the share of the residual on its straight part
  const double straight = (residual.array().abs() <= threshold).cast<double>().mean();
  return residual.cwiseMax(-threshold).cwiseMin(threshold) / straight;
}

std::string DescribeLoss(const Eigen::VectorXd& residual, double threshold) {
  if (std::isinf(threshold)) return "";
  const double far = kFarResidual / kHuberBend * threshold;
  return ExplainOutliers((residual.array().abs() > far).count(), residual.size(), kFarResidual);
}

}  // namespace warmjoint
