#include "identification/uncertainty/penalised_uncertainty.h"

#include <gtest/gtest.h>
#include <warmjoint/recording.h>

#include <Eigen/LU>
#include <cmath>

#include "models/foundation/random_stream.h"

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
      PenalisedCovariance({gram, inverse, 0, weight, 1, {false}, prior}, rows, residual, all);

  // to the scatter of the noise's variance, sqrt(2 / n) = 1 %, four times
  const double closed_form = 1.0 / (2.0 * double(n));
  EXPECT_NEAR(known.covariance(1, 1), closed_form, 0.04 * closed_form);
  EXPECT_NEAR(known.covariance(0, 1), 0, 0.01 * closed_form);
}

/// Two weights that the data know well and badly, and one that follows its neighbours; hardly any noise.
/// By hand: C = 1 / (g + s), B = s^2 g / (g + s)^2, L = g / (g + s), s_w^2 = sum B w^2 / sum B L^2.
TEST(PenalisedUncertainty, TakesTheWeightsVarianceFromThoseThatThePriorHoldsBack) {
  const Eigen::Index n = 3000;
  const double s = 10;
  const Eigen::Vector3d entries{1, 0.1, 0.1};
  const Eigen::Vector3d weight{1, 3, 100};
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(n, 3);
  Eigen::VectorXd residual(n);
  RandomStream random({1, 2}, Stream::torque_noise);
  for (Eigen::Index i = 0; i < n; ++i) {
    jacobian(i, i % 3) = entries[i % 3];
    residual[i] = 1e-6 * random.Normal();
  }
  const Eigen::MatrixXd gram = jacobian.transpose() * jacobian;
  const Eigen::Array3d g = gram.diagonal();  // 1000, 10, 10
  const Eigen::MatrixXd inverse = (1 / (g + s)).matrix().asDiagonal();
  Selection all;
  all.keep = Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(n, true);
  const auto rows = [&](Eigen::Index first, Eigen::Index last) -> Eigen::MatrixXd {
    return jacobian.middleRows(first, last - first);
  };
  const Uncertainty known =
      PenalisedCovariance({gram, inverse, 0, weight, s, {false, false, true}}, rows, residual, all);

  double above = 0, below = 0;
  for (const int k : {0, 1}) {
    const double b = s * s * g[k] / std::pow(g[k] + s, 2);
    above += b * weight[k] * weight[k];
    below += b * std::pow(g[k] / (g[k] + s), 2);
  }
  for (const int k : {0, 1}) {
    const double variance = above / below * std::pow(s / (g[k] + s), 2);
    EXPECT_NEAR(known.covariance(k, k), variance,
                1e-6 * variance);  // the noise is 1e-6 of the weights
  }
  EXPECT_LT(known.covariance(2, 2), 1e-12) << "it is not drawn from the prior";
}

}  // namespace
}  // namespace warmjoint
