#include "identification/model/ridge.h"

#include <gtest/gtest.h>
#include <warmjoint/friction.h>

#include "identification/linear/linear_laws.h"
#include "identification/maps/local_rows.h"
#include "identification/model/normal_equations.h"
#include "models/friction/evaluate_map.h"
#include "tests/support/vectors.h"

namespace warmjoint {
namespace {

/// The golden problem: 40 samples, columns [v, sign v] and six normalised kernels over position.
class GoldenRidge : public ::testing::Test {
 protected:
  void SetUp() override {
    golden_ = test::Golden().at("ridge");
    const std::vector<double> position = golden_.at("p");
    const Eigen::VectorXd velocity = test::ToVector(golden_.at("v"));
    y_ = test::ToVector(golden_.at("y"));
    const GaussianAxis axis{golden_.at("centers"), golden_.at("sigma"), {}, Sides::together};
    A_.resize(40, 8);
    A_.leftCols(2) = LawColumns(*FindLaw("viscous_coulomb"), velocity);
    std::vector<double> phi(6);
    for (int i = 0; i < 40; ++i) {
      AxisKernels(axis, KernelKind::normalised, position[i], phi.data());
      A_.row(i).tail(6) = Eigen::Map<Eigen::RowVectorXd>(phi.data(), 6);
    }
  }

  NormalEquations Normal(Eigen::Index begin, Eigen::Index count) const {
    NormalEquations normal(8);
    normal.Add(A_.middleRows(begin, count), y_.segment(begin, count));
    return normal;
  }

  nlohmann::json golden_;
  Eigen::MatrixXd A_;
  Eigen::VectorXd y_;
};

constexpr double kLinear = 1e-9;  // linear solves in another order of operations

TEST_F(GoldenRidge, ReproducesSolutionsAndEffectiveParameters) {
  const Ridge ridge(Normal(0, 40), 2);
  for (const auto& [strength, expected] : golden_.at("ridge").items()) {
    const Eigen::VectorXd x = test::ToVector(expected);
    EXPECT_LE((ridge.Solve(std::stod(strength)) - x).norm(), kLinear * x.norm()) << strength;
  }
  for (const auto& [strength, expected] : golden_.at("edof").items()) {
    EXPECT_NEAR(ridge.EffectiveParameters(std::stod(strength)), expected.get<double>(),
                kLinear * 8);
  }
}

TEST_F(GoldenRidge, ReproducesCrossValidationOfContiguousParts) {
  const Eigen::VectorXd expected = test::ToVector(golden_.at("cv5_contiguous_mse"));
  const std::vector<double> strengths = golden_.at("lambdas");
  Eigen::VectorXd errors = Eigen::VectorXd::Zero(4);
  const NormalEquations all = Normal(0, 40);
  for (int part = 0; part < 5; ++part) {
    const NormalEquations own = Normal(8 * part, 8);
    HeldOutPart held(own, all, 2);
    for (int i = 0; i < 4; ++i) errors[i] += held.Squares(strengths[static_cast<size_t>(i)]) / 40;
  }
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(errors[i], expected[i], kLinear * expected[i]);
}

TEST_F(GoldenRidge, ReproducesLeaveOneOut) {
  const std::vector<FrictionMap> maps{
      {{{MapQuantity::position, {golden_.at("centers"), golden_.at("sigma"), {}, Sides::together}}},
       KernelKind::normalised,
       {}}};
  MapPoints points = MapPoints::Zero(40, 5);
  points.col(0) = test::ToVector(golden_.at("p"));
  const std::vector<RowGroup> groups = GroupRows(maps, points, 0, 40);
  const Eigen::VectorXd expected = test::ToVector(golden_.at("loo_mse"));
  const std::vector<double> strengths = golden_.at("lambdas");
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(LeaveOneOut(groups, A_.leftCols(2), y_, Normal(0, 40), strengths[i]), expected[i],
                kLinear * expected[i]);
  }
}

TEST_F(GoldenRidge, ReproducesTheMostEvidence) {
  const nlohmann::json& golden = golden_.at("evidence");
  const NormalEquations normal = Normal(0, 40);
  const Evidence evidence = MaximiseEvidence(normal, 2);

  // 1e-6 on parameters, 1e-10 on the cost: iterative optimisers
  EXPECT_NEAR(evidence.alpha, golden.at("alpha"), 1e-6 * evidence.alpha);
  EXPECT_NEAR(evidence.beta, golden.at("beta"), 1e-6 * evidence.beta);
  EXPECT_NEAR(evidence.gamma, golden.at("gamma"), 1e-6 * evidence.gamma);
  EXPECT_NEAR(evidence.strength(), golden.at("lam"), 1e-6 * evidence.strength());
  EXPECT_NEAR(evidence.log_evidence, golden.at("L"), 1e-10 * evidence.log_evidence);
  const double given = golden_.at("log_evidence_at_alpha2_beta50");
  EXPECT_NEAR(LogEvidence(normal, Ridge(normal, 2), 2, 2, 50), given, kLinear * given);
}

}  // namespace
}  // namespace warmjoint
