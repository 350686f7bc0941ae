#include "identification/linear/robust.h"

#include <fmt/format.h>

#include <cmath>

#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

constexpr double kNormal = 1.4826;  // why: standard deviation over median size of normal noise
constexpr double kFarResidual = 4;  // standard deviations: one normal sample in 16 000
constexpr int kMostRounds = 100;
constexpr double kConverged = 1e-9;  // of the fitted torque between rounds, relative

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
  return fmt::format(
      "; {} of {} samples lie more than {:.0f} standard deviations off, and Huber's loss bounds "
      "their pull",
      (residual.array().abs() > far).count(), residual.size(), kFarResidual);
}

RobustLeastSquares SolveHuber(const Eigen::MatrixXd& A, const Eigen::VectorXd& y) {
  RobustLeastSquares robust;
  robust.fit = SolveLeastSquares(A, y);
  for (int round = 0; round < kMostRounds && robust.fit.mixed.empty(); ++round) {
    // the threshold follows the residual of the round before
    const Eigen::VectorXd fitted = A * robust.fit.solution;
    robust.threshold = HuberThreshold(y - fitted);

    // squares again, with less weight on what lies far off
    const Eigen::VectorXd root = HuberWeights(y - fitted, robust.threshold).cwiseSqrt();
    const LeastSquares next = SolveLeastSquares(root.asDiagonal() * A, root.cwiseProduct(y));
    if (!next.mixed.empty()) break;

    // until the fitted torque changes no more
    const double change = (A * next.solution - fitted).norm();
    robust.fit = next;
    robust.converged = change <= kConverged * fitted.norm();
    if (robust.converged) break;
  }
  // the errors follow from plain columns and the scores of the loss
  if (robust.fit.mixed.empty()) {
    robust.fit.cofactor = Cofactor(A.transpose() * A);
  }
  return robust;
}

}  // namespace warmjoint
