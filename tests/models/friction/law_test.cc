// Contract of all nominal laws, and the closed forms of each.
#include "models/friction/law.h"

#include <gmock/gmock.h>

#include <ostream>
#include <set>

namespace warmjoint {

void PrintTo(const Law& law, std::ostream* stream) { *stream << law.name; }

namespace {

const std::vector<double> kVelocities{-2, -0.5, -1e-9, 0, 1e-9, 0.3, 1.7};  // rad/s

class EveryLaw : public testing::TestWithParam<Law> {};

TEST_P(EveryLaw, IsFoundByName) { EXPECT_EQ(FindLaw(GetParam().name)->force, GetParam().force); }

TEST_P(EveryLaw, HasACompleteTable) {
  std::set<std::string_view> names;
  for (const ParameterInfo& info : GetParam().parameters) {
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_FALSE(info.symbol.empty());
    EXPECT_FALSE(info.unit.rotary.empty());
    EXPECT_FALSE(info.unit.linear.empty());
    EXPECT_FALSE(info.meaning.empty());
    EXPECT_LE(info.lower, info.default_value);
    EXPECT_LE(info.default_value, info.upper);
  }
  EXPECT_FALSE(GetParam().equation.empty());
}

TEST_P(EveryLaw, VanishesAtRestAndBrakesOtherwise) {
  const std::vector<double> p(GetParam().parameters.size(), 2.0);
  EXPECT_EQ(GetParam().force(0, p.data()), 0);
  for (double v : kVelocities) {
    if (v == 0) continue;
    EXPECT_GT(GetParam().force(v, p.data()) * v, 0) << v;
  }
}

TEST_P(EveryLaw, RegressorTimesParametersIsTheForce) {
  const size_t d = GetParam().parameters.size();
  std::vector<double> p(d), row(d);
  for (size_t i = 0; i < d; ++i) p[i] = 0.5 + 1.5 * static_cast<double>(i);
  for (double v : kVelocities) {
    Regressor(GetParam(), v, row.data());
    double sum = 0;
    for (size_t i = 0; i < d; ++i) sum += row[i] * p[i];
    EXPECT_DOUBLE_EQ(sum, GetParam().force(v, p.data()));
  }
}

std::string NameOf(const testing::TestParamInfo<Law>& member) {
  return std::string(member.param.name);
}

INSTANTIATE_TEST_SUITE_P(List, EveryLaw, testing::ValuesIn(Laws()), NameOf);

TEST(Laws, FollowTheirEquations) {
  const double coulomb[] = {15};
  EXPECT_EQ(FindLaw("coulomb")->force(-0.2, coulomb), -15);
  const double viscous_coulomb[] = {5, 15};
  EXPECT_EQ(FindLaw("viscous_coulomb")->force(0.5, viscous_coulomb), 17.5);
  EXPECT_EQ(FindLaw("viscous_coulomb")->force(-0.5, viscous_coulomb), -17.5);
  const double asymmetric[] = {5, 18, 25};
  EXPECT_EQ(FindLaw("asymmetric")->force(0.5, asymmetric), 20.5);
  EXPECT_EQ(FindLaw("asymmetric")->force(-0.5, asymmetric), -27.5);
}

TEST(Laws, UnknownNameIsNull) { EXPECT_EQ(FindLaw("stribek"), nullptr); }

}  // namespace
}  // namespace warmjoint
