#include "identification/linear/linear_laws.h"

#include <gtest/gtest.h>

namespace warmjoint {
namespace {

double QuadraticForce(double v, const double* p) { return p[0] * p[0] * v; }
double OffsetForce(double v, const double* p) { return p[0] * v + 1; }

TEST(LinearLaws, TellLinearFromNonlinear) {
  Law law = *FindLaw("asymmetric");
  EXPECT_TRUE(IsLinear(law));
  law.force = &QuadraticForce;
  EXPECT_FALSE(IsLinear(law));
  law.force = &OffsetForce;
  EXPECT_FALSE(IsLinear(law));
}

TEST(LinearLaws, LeaveOutLawsThatSteadySlidingDoesNotShow) {
  std::vector<std::string_view> names;
  for (const Word<LinearLaw>& word : WordsOf(LinearLaw())) names.push_back(word.name);
  EXPECT_EQ(names, (std::vector<std::string_view>{"coulomb", "viscous_coulomb", "asymmetric"}));
}

TEST(LinearLaws, ColumnsTimesParametersAreTheForce) {
  const Eigen::VectorXd v = Eigen::VectorXd::LinSpaced(9, -1, 1);
  for (const Law& law : Laws()) {
    if (!IsLinear(law)) continue;
    Eigen::VectorXd p = Eigen::VectorXd::LinSpaced(law.parameters.size(), 0.5, 2);
    const Eigen::VectorXd force = LawColumns(law, v) * p;
    // three products and two sums
    for (int i = 0; i < 9; ++i) EXPECT_NEAR(force[i], law.force(v[i], p.data()), 1e-15) << law.name;
  }
}

}  // namespace
}  // namespace warmjoint
