// Figures of a fit, errors of parameters and their bound.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/estimate.h>
#include <warmjoint/score.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "identification/fit/fit_data.h"
#include "identification/linear/linear_laws.h"
#include "identification/preparation/select.h"
#include "identification/score/cramer_rao.h"
#include "tests/support/vectors.h"

namespace warmjoint {
namespace {

using ::testing::ElementsAre;
using ::testing::Field;

/// The truth behind the golden recording: kv 5, kc 15, k -3, tau 600 s; noise 0.5 N.m.
Truth GoldenTruth() {
  Truth truth;
  truth.friction.parameters = {{"viscous", 5}, {"coulomb", 15}};
  truth.friction.thermal = Thermal{-3, 600};
  truth.torque_noise = 0.5;
  truth.velocity = test::ToVector(test::Golden().at("dataset").at("v"));
  return truth;
}

Estimate Estimated(std::vector<EstimatedParameter> parameters) {
  Estimate estimate;
  estimate.parameters = std::move(parameters);
  return estimate;
}

void ExpectNear(const Eigen::MatrixXd& actual, const nlohmann::json& golden, double tolerance) {
  const Eigen::MatrixXd expected =
      golden[0].is_array() ? test::ToMatrix(golden) : Eigen::MatrixXd(test::ToVector(golden));
  ASSERT_EQ(actual.rows(), expected.rows());
  EXPECT_LE(((actual - expected).array() / expected.array()).abs().maxCoeff(), tolerance) << actual;
}

// 1e-9: an inverse of a 4 x 4 or 5 x 5 matrix, formed in another order of operations
TEST(CramerRao, ReproducesTheGoldenBound) {
  const nlohmann::json& golden = test::Golden().at("dataset");
  const Measurements recording = test::GoldenRecording();
  const CramerRao bound = CramerRaoBound(LogSamples(recording), SelectMoving(recording),
                                         GoldenTruth(), KnownInitialEnergy::yes, 15);
  ExpectNear(bound.continuous, golden.at("crlb_std_kv_kc_kbar_tbar"), 1e-9);
  ExpectNear(bound.discrete, golden.at("crlb_std_kv_kc_ke_te"), 1e-9);
  ExpectNear(bound.information, golden.at("crlb_FIM"), 1e-9);
}

TEST(CramerRao, ReproducesTheGoldenBoundWithUnknownInitialEnergy) {
  const nlohmann::json& golden = test::Golden().at("dataset").at("crlb_std_with_E0");
  const Measurements recording = test::GoldenRecording();
  const CramerRao bound = CramerRaoBound(LogSamples(recording), SelectMoving(recording),
                                         GoldenTruth(), KnownInitialEnergy::no, 15);
  ExpectNear(bound.continuous, {golden[0], golden[1], golden[2], golden[3]}, 1e-9);
}

TEST(CramerRao, OfColouredNoiseIsThatOfItsCovariance) {
  const Measurements recording = test::GoldenRecording();
  const Selection selection = SelectMoving(recording);
  Truth truth = GoldenTruth();
  truth.friction.thermal.reset();
  truth.coloured_noise = 0.4;
  truth.correlation_time = 40;
  const CramerRao bound =
      CramerRaoBound(LogSamples(recording), selection, truth, KnownInitialEnergy::yes, 15);

  // A^T R^-1 A written out
  const Eigen::VectorXd time = Kept(recording.time, selection);
  const Eigen::MatrixXd A =
      Kept(LawColumns(*FindLaw("viscous_coulomb"), truth.velocity), selection);
  Eigen::MatrixXd R = 0.09 * Eigen::MatrixXd::Identity(time.size(), time.size());
  for (Eigen::Index i = 0; i < time.size(); ++i) {
    for (Eigen::Index j = 0; j < time.size(); ++j) {
      R(i, j) += 0.16 * std::exp(-std::abs(time[i] - time[j]) / 40);
    }
  }
  const Eigen::MatrixXd expected = A.transpose() * R.llt().solve(A);
  EXPECT_LT((bound.information - expected).norm(), 1e-9 * expected.norm());
}

TEST(CramerRao, DoesNotExistWithoutNoise) {
  const Measurements recording = test::GoldenRecording();
  Truth truth = GoldenTruth();
  truth.torque_noise = 0;
  const CramerRao bound = CramerRaoBound(LogSamples(recording), SelectMoving(recording), truth,
                                         KnownInitialEnergy::yes, 15);
  EXPECT_TRUE(bound.continuous.array().isNaN().all());
}

TEST(Score, SumsTheBoundAsNpe) {
  const Measurements recording = test::GoldenRecording();
  const Score score =
      ScoreEstimate(Estimated({}), LogSamples(recording), SelectMoving(recording), GoldenTruth());
  const double golden = test::Golden().at("dataset").at("crlb_rmsNPE_cont");
  EXPECT_NEAR(score.bound_npe_continuous, golden, 1e-9 * golden);
}

TEST(Score, CountsWhatIsNotEstimatedAsZero) {
  const Measurements recording = test::GoldenRecording();
  const Score score =
      ScoreEstimate(Estimated({{"viscous", 5, "", 0.1, {{4.8, 5.2}}}, {"coulomb", 12, "", {}, {}}}),
                    LogSamples(recording), SelectMoving(recording), GoldenTruth());

  // sqrt(0 + 0.2^2 + 1 + 1)
  EXPECT_NEAR(score.npe_continuous, std::sqrt(2.04), 1e-14);
  EXPECT_NEAR(score.npe_discrete, std::sqrt(2.04), 1e-14);
  EXPECT_THAT(score.continuous, ElementsAre(Field(&ParameterScore::name, "viscous"),
                                            Field(&ParameterScore::name, "coulomb"),
                                            Field(&ParameterScore::name, "thermal_gain"),
                                            Field(&ParameterScore::name, "thermal_time_constant")));
  EXPECT_EQ(score.continuous[0].covered, true);
  EXPECT_EQ(score.continuous[1].covered, std::nullopt);
  EXPECT_TRUE(score.continuous[1].estimated);
  EXPECT_FALSE(score.continuous[2].estimated);
  EXPECT_EQ(score.continuous[2].estimate, 0);
}

TEST(Score, LeavesParametersThatAreTrulyZeroOutOfTheNpe) {
  const Measurements recording = test::GoldenRecording();
  Truth truth = GoldenTruth();
  truth.friction.parameters["viscous"] = 0;
  truth.friction.thermal.reset();
  const Score score =
      ScoreEstimate(Estimated({{"viscous", 1, "", {}, {}}, {"coulomb", 15, "", {}, {}}}),
                    LogSamples(recording), SelectMoving(recording), truth);
  EXPECT_EQ(score.npe_continuous, 0);
  EXPECT_EQ(score.continuous.size(), 2u);
}

TEST(NormalisedParameterError, ReproducesTheGoldenNumber) {
  const nlohmann::json& golden = test::Golden().at("npe");
  const Eigen::VectorXd estimate = test::ToVector(golden.at("xhat"));
  const Eigen::VectorXd truth = test::ToVector(golden.at("x"));
  const double total = golden.at("total");
  EXPECT_NEAR(NormalisedParameterError(estimate, truth), total, 1e-12 * total);  // closed form
}

TEST(NormalisedParameterError, IsWhatAHandMakesOfThreeParameters) {
  // a tenth, a fifth of a negative one, and none: sqrt(0.01 + 0.04)
  EXPECT_DOUBLE_EQ(
      NormalisedParameterError(Eigen::Vector3d(5.5, -8, 600), Eigen::Vector3d(5, -10, 600)),
      std::sqrt(0.05));
}

TEST(Metrics, ReproduceTheGoldenIndicators) {
  const nlohmann::json& golden = test::Golden().at("indicators");
  const int d = golden.at("d");
  const Metrics metrics =
      ComputeMetrics(test::ToVector(golden.at("y")), test::ToVector(golden.at("yhat")), d, d);

  // 1e-12: closed forms
  EXPECT_NEAR(metrics.fit, golden.at("Fit"), 1e-12 * 100);
  EXPECT_NEAR(metrics.fpe, golden.at("FPE"), 1e-12);
  EXPECT_NEAR(metrics.rmse, golden.at("RMSE"), 1e-12);
  EXPECT_NEAR(metrics.mae, golden.at("MAE"), 1e-12);
  EXPECT_EQ(metrics.n, 5);
}

TEST(Metrics, AreWhatAHandMakesOfFourSamples) {
  // errors 1, -1, 3, -1: mean square 12/4, mean size 6/4
  const Eigen::Vector4d measured(2, 4, 6, 8), fitted(1, 5, 3, 9);
  const Metrics metrics = ComputeMetrics(measured, fitted, 1, 1);
  EXPECT_DOUBLE_EQ(metrics.rmse, std::sqrt(3.0));
  EXPECT_DOUBLE_EQ(metrics.mae, 1.5);
  // about the mean 5: 9 + 1 + 1 + 9 = 20
  EXPECT_DOUBLE_EQ(metrics.fit, 100 * (1 - std::sqrt(12.0 / 20)));
  // 3 (1 + 1/4)/(1 - 1/4)
  EXPECT_DOUBLE_EQ(metrics.fpe, 5);
  EXPECT_EQ(metrics.n, 4);
}

TEST(Metrics, KnowNoErrorToPredictWithoutASampleToSpare) {
  // (1 + d/n)/(1 - d/n) has no meaning from d = n on, where it would be negative
  const Eigen::Vector3d measured(1, 2, 6), fitted(1, 2, 5);
  EXPECT_GT(ComputeMetrics(measured, fitted, 2, 2).fpe, 0);
  EXPECT_TRUE(std::isnan(ComputeMetrics(measured, fitted, 3, 3).fpe));
  EXPECT_TRUE(std::isnan(ComputeMetrics(measured, fitted, 40, 3).fpe));
  // nor a constant torque a share to explain
  const Eigen::Vector3d constant(2, 2, 2);
  EXPECT_TRUE(std::isnan(ComputeMetrics(constant, fitted, 1, 1).fit));
}

}  // namespace
}  // namespace warmjoint
