#include "identification/linear/least_squares.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <cmath>
#include <limits>

#include "identification/sentences/fit.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

constexpr double kNormal = 1.4826;  // why: standard deviation over median size of normal noise
constexpr double kFarResidual = 4;  // standard deviations: one normal sample in 16 000

}  // namespace

LeastSquares SolveLeastSquares(const Eigen::MatrixXd& A, const Eigen::VectorXd& y,
                               double indistinct) {
  const Eigen::Index d = A.cols();
  LeastSquares result;

  // columns of norm 1; a column of zeros stays as it is
  Eigen::VectorXd scale = A.colwise().norm();
  for (double& norm : scale) norm = norm > 0 ? 1 / norm : 1;

  // A S = Q R, R = U D V^T
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(A * scale.asDiagonal());
  const Eigen::MatrixXd R = qr.matrixQR().topRows(d).triangularView<Eigen::Upper>();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(R, Eigen::ComputeFullV);

  // directions that the data leave open, and columns with a share of at least a tenth in any of them
  const Eigen::VectorXd& singular = svd.singularValues();
  result.rank = (singular.array() > indistinct * singular[0]).count();
  if (result.rank < d) {
    const Eigen::MatrixXd open = svd.matrixV().rightCols(d - result.rank);
    for (Eigen::Index i = 0; i < d; ++i) {
      if (open.row(i).norm() > 0.1) result.mixed.push_back(i);
    }
    return result;
  }

  // x = S R^-1 Q^T y and (A^T A)^-1 = (S R^-1) (S R^-1)^T
  const Eigen::VectorXd projected = (qr.householderQ().adjoint() * y).head(d);
  result.solution = scale.asDiagonal() * R.triangularView<Eigen::Upper>().solve(projected);
  const Eigen::MatrixXd inverse =
      scale.asDiagonal() * R.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(d, d));
  result.cofactor = inverse * inverse.transpose();
  return result;
}

Eigen::MatrixXd GramOf(const Eigen::MatrixXd& J) {
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(J.cols(), J.cols());
  if (J.rows() > 0) gram.selfadjointView<Eigen::Lower>().rankUpdate(J.transpose());
  gram.triangularView<Eigen::StrictlyUpper>() = gram.transpose();
  return gram;
}

Eigen::MatrixXd Cofactor(const Eigen::MatrixXd& normal) {
  const Eigen::Index p = normal.rows();

  // scaled to a diagonal of 1, so that units do not count
  const Eigen::VectorXd scale = normal.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LDLT<Eigen::MatrixXd> factors(scale.asDiagonal() * normal * scale.asDiagonal());
  // columns that are not told apart leave the errors without a bound
  if (!scale.allFinite() || !(factors.vectorD().minCoeff() > 1e-13)) {
    return Eigen::MatrixXd::Constant(p, p, std::numeric_limits<double>::infinity());
  }
  return scale.asDiagonal() * factors.solve(Eigen::MatrixXd::Identity(p, p)) * scale.asDiagonal();
}

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
