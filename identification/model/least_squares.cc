#include "identification/model/least_squares.h"

#include <Eigen/QR>
#include <Eigen/SVD>

namespace warmjoint {
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

  // directions that the data do not determine, and columns with a share of at least a tenth in any of them
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

}  // namespace warmjoint
