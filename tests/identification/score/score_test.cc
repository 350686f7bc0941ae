#include <gmock/gmock.h>
#include <warmjoint/score.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "identification/fit_data.h"
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
  const CramerRao bound = CramerRaoBound(recording, SelectMoving(recording), GoldenTruth(),
                                         KnownInitialEnergy::yes, 15);
  ExpectNear(bound.continuous, golden.at("crlb_std_kv_kc_kbar_tbar"), 1e-9);
  ExpectNear(bound.discrete, golden.at("crlb_std_kv_kc_ke_te"), 1e-9);
  ExpectNear(bound.information, golden.at("crlb_FIM"), 1e-9);
}

TEST(CramerRao, ReproducesTheGoldenBoundWithUnknownInitialEnergy) {
  const nlohmann::json& golden = test::Golden().at("dataset").at("crlb_std_with_E0");
  const Measurements recording = test::GoldenRecording();
  const CramerRao bound =
      CramerRaoBound(recording, SelectMoving(recording), GoldenTruth(), KnownInitialEnergy::no, 15);
  ExpectNear(bound.continuous, {golden[0], golden[1], golden[2], golden[3]}, 1e-9);
}

TEST(CramerRao, OfColouredNoiseIsThatOfItsCovariance) {
  const Measurements recording = test::GoldenRecording();
  const Selection selection = SelectMoving(recording);
  Truth truth = GoldenTruth();
  truth.friction.thermal.reset();
  truth.coloured_noise = 0.4;
  truth.correlation_time = 40;
  const CramerRao bound = CramerRaoBound(recording, selection, truth, KnownInitialEnergy::yes, 15);

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
  const CramerRao bound =
      CramerRaoBound(recording, SelectMoving(recording), truth, KnownInitialEnergy::yes, 15);
  EXPECT_TRUE(bound.continuous.array().isNaN().all());
}

TEST(Score, SumsTheBoundAsNpe) {
  const Measurements recording = test::GoldenRecording();
  const Score score =
      ScoreEstimate(Estimated({}), recording, SelectMoving(recording), GoldenTruth());
  const double golden = test::Golden().at("dataset").at("crlb_rmsNPE_cont");
  EXPECT_NEAR(score.bound_npe_continuous, golden, 1e-9 * golden);
}

TEST(Score, CountsWhatIsNotEstimatedAsZero) {
  const Measurements recording = test::GoldenRecording();
  const Score score =
      ScoreEstimate(Estimated({{"viscous", 5, "", 0.1, {{4.8, 5.2}}}, {"coulomb", 12, "", {}, {}}}),
                    recording, SelectMoving(recording), GoldenTruth());

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
      ScoreEstimate(Estimated({{"viscous", 1, "", {}, {}}, {"coulomb", 15, "", {}, {}}}), recording,
                    SelectMoving(recording), truth);
  EXPECT_EQ(score.npe_continuous, 0);
  EXPECT_EQ(score.continuous.size(), 2u);
}

}  // namespace
}  // namespace warmjoint
