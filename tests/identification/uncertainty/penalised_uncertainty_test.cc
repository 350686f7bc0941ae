#include "identification/uncertainty/penalised_uncertainty.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "models/foundation/random_stream.h"
#include "models/recording/selection.h"

namespace warmjoint {
namespace {

/// A level that was known beforehand to one standard error of the log's, beside a weight of +-1 in
/// turn: by hand its variance is s^2 / (n + n), of which a half comes from either.
TEST(PenalisedUncertainty, CountsWhatWasKnownBeforehandAsOneMoreMeasurement) {
  const Eigen::Index n = 20000;
  Eigen::MatrixXd jacobian(n, 2);
  Eigen::VectorXd residual(n);
  RandomStream random({1, 1}, Stream::torque_noise);
  for (Eigen::Index i = 0; i < n; ++i) {
    jacobian.row(i) << (i % 2 == 0 ? 1.0 : -1.0), 1.0;
    residual[i] = random.Normal();
  }
  const Eigen::MatrixXd gram = jacobian.transpose() * jacobian;
  const Eigen::VectorXd prior{{0, double(n)}};
  Eigen::MatrixXd penalised = gram;
  penalised(0, 0) += 1;
  penalised(1, 1) += prior[1];
  const Eigen::MatrixXd inverse = penalised.inverse();
  Selection all;
  all.keep = Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(n, true);
  const auto rows = [&](Eigen::Index first, Eigen::Index last) -> Eigen::MatrixXd {
    return jacobian.middleRows(first, last - first);
  };
  const Eigen::VectorXd weight = Eigen::VectorXd::Constant(1, 0.5);
  const Uncertainty known =
      JudgePenalised({gram, inverse, 0, weight, 1, prior}, rows, residual, all);

  // to the scatter of the noise's variance, sqrt(2 / n) = 1 %, four times
  const double closed_form = 1.0 / (2.0 * double(n));
  EXPECT_NEAR(known.covariance(1, 1), closed_form, 0.04 * closed_form);
  EXPECT_NEAR(known.covariance(0, 1), 0, 0.01 * closed_form);
}

}  // namespace
}  // namespace warmjoint
