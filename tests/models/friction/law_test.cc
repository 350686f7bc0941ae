// Contract of all nominal laws; that each is its equation, tests/models/friction/golden_motion_test.cc says.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <set>
#include <tuple>

#include "models/friction/joint_friction.h"
#include "models/friction/laws.h"
#include "models/friction/parameter_rows.h"

namespace warmjoint {

void PrintTo(const Law& law, std::ostream* stream) { *stream << law.name; }

namespace {

const std::vector<double> kVelocities{-2, -0.5, -1e-9, 0, 1e-9, 0.3, 1.7};  // rad/s

class EveryLaw : public testing::TestWithParam<Law> {};

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

TEST_P(EveryLaw, MeansTheSameByANameAsEveryOtherLaw) {
  const auto row = [](const ParameterInfo& info) {
    return std::tuple(info.symbol, info.unit.rotary, info.unit.linear, info.lower, info.upper,
                      info.default_value, info.meaning, info.given, info.part);
  };
  for (const Law& other : Laws()) {
    for (const ParameterInfo& theirs : other.parameters) {
      for (const ParameterInfo& ours : GetParam().parameters) {
        if (ours.name == theirs.name) {
          EXPECT_EQ(row(ours), row(theirs)) << ours.name << other.name;
        }
      }
    }
  }
}

/// The levels of a law, which says of itself whether they are the same at any speed.
template <typename L>
void ExpectSameLevelAtAnySpeed() {
  if constexpr (LawAtAnySpeed<L>) {
    const std::vector<double> p(L::parameters.size(), 2.0);
    for (const int side : {-1, 1}) {
      for (const double speed : {1e-9, 0.3, 7.0}) {
        EXPECT_EQ(L::Level(side, speed, p.data()), L::Level(side, 0, p.data())) << L::name;
      }
    }
  }
}

template <typename... L>
int ExpectSameLevels(LawList<L...>) {
  (ExpectSameLevelAtAnySpeed<L>(), ...);
  return (int{LawAtAnySpeed<L>} + ...);
}

TEST(Laws, SayRightlyThatTheirLevelIsTheSameAtAnySpeed) {
  EXPECT_GE(ExpectSameLevels(AllLaws{}), 4) << "coulomb, viscous_coulomb, asymmetric, stiction";
}

TEST_P(EveryLaw, VanishesAtRestAndBrakesOtherwise) {
  const std::vector<double> p(GetParam().parameters.size(), 2.0);
  EXPECT_EQ(GetParam().force(0, p.data()), 0);
  for (double v : kVelocities) {
    if (v == 0) continue;
    EXPECT_GT(GetParam().force(v, p.data()) * v, 0) << v;
  }
}

bool Has(const Law& law, std::string_view name) {
  return std::ranges::any_of(law.parameters,
                             [&](const ParameterInfo& info) { return info.name == name; });
}

/// Parameters that differ from each other, with static above coulomb.
std::vector<double> SomeParameters(const Law& law) {
  std::vector<double> p(law.parameters.size());
  for (size_t i = 0; i < p.size(); ++i) p[i] = 0.5 + 1.5 * static_cast<double>(i);
  return p;
}

TEST_P(EveryLaw, IsOddExceptWhereItsSidesDiffer) {
  const Law& law = GetParam();
  if (Has(law, "coulomb_negative")) GTEST_SKIP() << "its sides differ";
  const std::vector<double> p = SomeParameters(law);
  for (const double v : kVelocities) EXPECT_EQ(law.force(-v, p.data()), -law.force(v, p.data()));
  EXPECT_EQ(law.holding_level(1, p.data()), law.holding_level(-1, p.data()));
}

TEST_P(EveryLaw, HoldsAtRestAtLeastWhatItBrakesWithAtTheSmallestSpeed) {
  const std::vector<double> p = SomeParameters(GetParam());
  for (const int side : {1, -1}) {
    const double sliding = std::abs(GetParam().force(side * 1e-12, p.data()));
    // kv |v| at 1e-12 rad/s
    EXPECT_GE(GetParam().holding_level(side, p.data()), sliding - 1e-11);
  }
}

TEST_P(EveryLaw, AllowsItsBoundsAndDefaults) {
  // every force at the ends of the table is a number that does not push
  for (const ParameterInfo& info : GetParam().parameters) {
    for (const double value : {info.lower, std::min(info.upper, 1e9), info.default_value}) {
      std::vector<double> p = SomeParameters(GetParam());
      p[&info - GetParam().parameters.data()] = value;
      for (const double v : kVelocities) EXPECT_GE(GetParam().force(v, p.data()) * v, 0) << v;
    }
  }
}

std::string NameOf(const testing::TestParamInfo<Law>& member) {
  return std::string(member.param.name);
}

INSTANTIATE_TEST_SUITE_P(List, EveryLaw, testing::ValuesIn(Laws()), NameOf);

TEST(Laws, FallFromTheStaticLevelToCoulombOverTheStribeckVelocity) {
  // at vs, exp(-1) of static - coulomb is left, for any exponent
  const double left = 15 + (18 - 15) * std::exp(-1);
  for (const double exponent : {0.5, 1.0, 2.0, 3.0}) {
    const double p[] = {5, 15, 18, 0.2, exponent};
    EXPECT_DOUBLE_EQ(FindLaw("stribeck")->force(0.2, p), 5 * 0.2 + left);
    EXPECT_DOUBLE_EQ(FindLaw("stribeck")->force(-1e3, p), -5e3 - 15);
    EXPECT_EQ(FindLaw("stribeck")->holding_level(-1, p), 18);
  }
  const double lugre[] = {5, 15, 18, 0.2, 1e4, 10};
  const double stribeck[] = {5, 15, 18, 0.2, 2};
  for (const double v : kVelocities) {
    EXPECT_EQ(FindLaw("lugre")->force(v, lugre), FindLaw("stribeck")->force(v, stribeck));
  }
}

TEST(LawPart, IsALevelInEveryLawAndAnythingElseAtMostOnce) {
  EXPECT_EQ(PartOf("thermal_gain"), LawPart::other) << "which no law has";
  for (const Law& law : Laws()) {
    for (const ParameterInfo& info : law.parameters) EXPECT_EQ(PartOf(info.name), info.part);
    EXPECT_TRUE(PlaceOf(LawPart::level, law)) << law.name;
    for (const LawPart part :
         {LawPart::slope, LawPart::rest_level, LawPart::rest_rise, LawPart::bristle}) {
      const auto is_part = [&](const ParameterInfo& info) { return info.part == part; };
      EXPECT_LE(std::ranges::count_if(law.parameters, is_part), 1) << law.name;
    }
  }
}

TEST(LawPart, TellsTheSlopeOfEveryForce) {
  for (const Law& law : Laws()) {
    const std::optional<size_t> place = PlaceOf(LawPart::slope, law);
    if (!place) continue;
    std::vector<double> p(law.parameters.size(), 2.0);
    const double before = law.force(0.5, p.data());
    p[*place] += 1;
    // one difference of numbers near 3
    EXPECT_NEAR(law.force(0.5, p.data()) - before, 0.5, 1e-15) << law.name;
  }
}

TEST(LawPart, TellsTheBristleOfEveryLawThatBringsOne) {
  for (const Law& law : Laws()) {
    Friction friction;
    friction.law = law.name;
    friction.parameters.clear();
    for (const ParameterInfo& info : law.parameters)
      friction.parameters[std::string(info.name)] = 2;
    const std::optional<size_t> place = PlaceOf(LawPart::bristle, law);
    if (place) friction.parameters[std::string(law.parameters[*place].name)] = 300;
    const std::optional<Bristle> own = JointFriction(friction).own_bristle();
    EXPECT_EQ(place.has_value(), law.pre_sliding == PreSliding::bristle) << law.name;
    ASSERT_EQ(own.has_value(), place.has_value()) << law.name;
    if (!own) continue;
    EXPECT_EQ(own->stiffness, 300) << law.name;
  }
}

}  // namespace
}  // namespace warmjoint
