#include <gmock/gmock.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "tests/support/judging.h"
#include "tests/support/vectors.h"

namespace warmjoint {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

Estimate FitLaw(const Measurements& measurements, const std::string& law) {
  return test::Fitted("nominal-ls", measurements, {{"law", law}});
}

/// A recording of a joint with kv = 2 N.m.s/rad and kc = 7 N.m.
Measurements Moved(double step, const Eigen::VectorXd& v) {
  return test::Record(step, v, v.unaryExpr([](double x) { return 2 * x + 7 * Sign(x); }));
}

/// Of these speeds (rad/s) in turn, 10 samples each.
Measurements Steps(const std::vector<double>& speeds) {
  return Moved(0.1, test::Finer(Eigen::VectorXd::Map(speeds.data(), std::ssize(speeds)), 10));
}

TEST(NominalLs, ReproducesTheGoldenSolutions) {
  const nlohmann::json& golden = test::Golden().at("dataset");
  const Measurements recording = test::GoldenRecording();

  // 1e-9: linear solve of a well-conditioned problem in another order of operations
  const Eigen::VectorXd law2 = test::ToVector(golden.at("LS_nominal_(2)"));
  const Estimate two = FitLaw(recording, "viscous_coulomb");
  EXPECT_NEAR(two.Find("viscous")->value, law2[0], 1e-9 * law2[0]);
  EXPECT_NEAR(two.Find("coulomb")->value, law2[1], 1e-9 * law2[1]);

  const Eigen::VectorXd law3 = test::ToVector(golden.at("LS_nominal_(3)"));
  const Estimate three = FitLaw(recording, "asymmetric");
  EXPECT_NEAR(three.Find("viscous")->value, law3[0], 1e-9 * law3[0]);
  EXPECT_NEAR(three.Find("coulomb_positive")->value, law3[1], 1e-9 * law3[1]);
  EXPECT_NEAR(three.Find("coulomb_negative")->value, law3[2], 1e-9 * law3[2]);

  // the golden variance counts the samples at rest too, where the law gives 0
  const Metrics& metrics = *two.metrics;
  const double rests = (recording.velocity.array() == 0).select(recording.torque, 0).squaredNorm();
  const double squares = metrics.rmse * metrics.rmse * metrics.n + rests;
  const double variance = golden.at("sigma2_hat_LS2");
  EXPECT_NEAR(squares / (240 - 2), variance, 1e-9 * variance);
}

TEST(NominalLs, SaysThatAnUnseenDirectionIsNotIdentifiable) {
  const Estimate estimate = FitLaw(Steps({0.2, 1.0}), "asymmetric");
  EXPECT_EQ(estimate.status, Status::not_identifiable);
  EXPECT_THAT(estimate.message, AllOf(HasSubstr("coulomb_negative"), HasSubstr("both directions"),
                                      Not(HasSubstr("viscous"))));
}

TEST(NominalLs, CallsUnusableDataBad) {
  Measurements not_a_number = Steps({0.2, 1.0});
  not_a_number.torque[3] = std::numeric_limits<double>::quiet_NaN();
  const Estimate nan = FitLaw(not_a_number, "coulomb");
  EXPECT_EQ(nan.status, Status::bad_data);
  EXPECT_THAT(nan.message, HasSubstr("torque is nan at sample 3"));

  Measurements constant = Steps({0.2, 1.0});
  constant.torque.setConstant(4);
  EXPECT_EQ(FitLaw(constant, "coulomb").status, Status::bad_data);
  EXPECT_EQ(FitLaw(Steps({0.0}), "coulomb").status, Status::bad_data);
}

TEST(NominalLs, GivesNoFrictionWhereTheLawForbidsTheValue) {
  Measurements falling = Steps({0.2, -0.5, 1.0, -1.0});
  falling.torque -= 3 * falling.velocity;
  const Estimate estimate = FitLaw(falling, "viscous_coulomb");
  EXPECT_EQ(estimate.status, Status::inadequate_model);
  EXPECT_THAT(estimate.message,
              HasSubstr("viscous is -1 N.m.s/rad, below its bound 0, with its whole 95 %"));
  EXPECT_FALSE(estimate.friction);
}

TEST(NominalLs, CarriesTheUnitOfALoggedCurrent) {
  Measurements current = Steps({0.2, -0.5, 1.0});
  current.torque_unit = "A";
  const Estimate estimate = FitLaw(current, "viscous_coulomb");
  EXPECT_EQ(estimate.Find("viscous")->unit, "A.s/rad");
  EXPECT_EQ(estimate.Find("coulomb")->unit, "A");
}

TEST(NominalLs, WeighsColouredNoiseByItsColour) {
  // plain squares leave 2.4 times the bound of such noise (README.md): 60 fits tell 1.0 from that
  constexpr int kFits = 60;
  double squares = 0, bound = 0;
  int held = 0;
  for (std::uint64_t seed = 0; seed < kFits; ++seed) {
    // of 0.5 N.m, whose neighbours correlate
    Measurements m = Moved(1, test::AlternatingSpeeds(2000, seed));
    test::AddNoise(m, 0.5, 0.9, seed);
    const Estimate estimate = FitLaw(m, "viscous_coulomb");
    squares += std::pow(estimate.Find("coulomb")->value - 7, 2);
    held += test::Holds(estimate, "coulomb", 7);

    // differences e[i] - 0.9 e[i-1] are white
    Eigen::MatrixXd A(m.size(), 2);
    A << m.velocity, m.velocity.unaryExpr([](double x) { return static_cast<double>(Sign(x)); });
    const Eigen::MatrixXd rows = A.bottomRows(m.size() - 1) - 0.9 * A.topRows(m.size() - 1);
    const Eigen::Matrix2d normal = rows.transpose() * rows;
    bound += 0.25 * (1 - 0.81) * normal.inverse()(1, 1);
  }
  // standard error of a root mean square of 60: 9 %
  EXPECT_LT(std::sqrt(squares / bound), 1 + 3 * 0.09);
  EXPECT_GE(held, 52);  // 95 %, less three deviations of 2.8 %
}

}  // namespace
}  // namespace warmjoint
