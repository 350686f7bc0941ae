#include "identification/gravity.h"

#include <gmock/gmock.h>
#include <warmjoint/prepared_log.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "identification/answer/identify.h"
#include "identification/holdout/hold_out.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/linear/rigid_part.h"
#include "identification/preparation/select.h"
#include "identification/sentences/friction.h"
#include "models/foundation/serialize.h"
#include "tests/support/judging.h"
#include "tests/support/refusal.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

/// Two hours at 1 s, from cold, with rests; gravity 8 sin p - 3 cos p where `pull` is 1.
Measurements Record(double pull, std::uint64_t seed, double coupled = 0) {
  Measurements m = test::RecordFriction(test::TableOne(), 1,
                                        test::AlternatingSpeeds(7200, seed, 600), 0.5, seed);
  const Eigen::ArrayXd p = m.position.array();
  m.torque.array() += pull * (8 * p.sin() - 3 * p.cos() + coupled * (3 * p).sin());
  return m;
}

Estimate Identify(const Identifier& identifier, const Measurements& m, const std::string& gravity,
                  std::map<std::string, std::string> given = {}) {
  given["gravity"] = gravity;
  for (const OptionInfo& option : identifier.options.List()) {
    if (option.name == "iterations") given["iterations"] = "500";
  }
  return test::Fitted(identifier.name, Prepare(m, SelectMoving(m)), given, {11, 3});
}

/// How far the friction of two estimates of the same noise is apart.
void ExpectSameFriction(const Estimate& with, const Estimate& without) {
  ASSERT_EQ(with.status, Status::ok) << with.message;
  ASSERT_EQ(without.status, Status::ok) << without.message;
  for (const EstimatedParameter& parameter : without.parameters) {
    const EstimatedParameter* other = with.Find(parameter.name);
    ASSERT_TRUE(other) << parameter.name;
    // intervals of both together; without any, twice the 1 % within which energy-als stops
    double tolerance = 0.02 * std::abs(parameter.value);
    if (parameter.std) tolerance = 1.96 * std::hypot(*parameter.std, *other->std);
    EXPECT_NEAR(other->value, parameter.value, tolerance) << parameter.name;
  }
}

class TellingGravity : public ::testing::TestWithParam<Identifier> {};

TEST_P(TellingGravity, GivesTheFrictionOfTheRunWithoutGravity) {
  const Estimate without = Identify(GetParam(), Record(0, 1), "none");
  for (const char* gravity : {"sincos", "paired"}) {
    SCOPED_TRACE(gravity);
    ExpectSameFriction(Identify(GetParam(), Record(1, 1), gravity), without);
  }
}

TEST_P(TellingGravity, FindsTheWeight) {
  const Estimate estimate = Identify(GetParam(), Record(1, 2), "sincos");
  ASSERT_TRUE(estimate.gravity) << estimate.message;
  // a warm-up that is left in the residual is 2 N.m rms: 3600 samples leave 2 sqrt(2/3600) of it,
  // three times
  const bool warms = estimate.Find("thermal_gain") != nullptr;
  const double tolerance = 3 * (warms ? 0.5 : 2) * std::sqrt(2.0 / 3600);
  EXPECT_NEAR(estimate.gravity->values[0], 8, tolerance);
  EXPECT_NEAR(estimate.gravity->values[1], -3, tolerance);
  EXPECT_EQ(estimate.Find("gravity_sine")->value, estimate.gravity->values[0]);
  EXPECT_EQ(estimate.Find("gravity_cosine")->unit, "N.m");
}

TEST_P(TellingGravity, TakesAWeightOffALinearJoint) {
  Measurements m = Record(0, 3);
  const Estimate without = Identify(GetParam(), m, "none");
  m.joint = JointKind::linear;
  m.torque_unit = "N";
  m.torque.array() += 12;
  const Estimate estimate = Identify(GetParam(), m, "paired");
  ExpectSameFriction(estimate, without);
  EXPECT_EQ(estimate.Find("gravity_offset")->unit, "N");
  EXPECT_THAT(Identify(GetParam(), m, "sincos").message, HasSubstr("use gravity paired"));
}

TEST_P(TellingGravity, RefusesALawThatTakesTheWeightForFriction) {
  Measurements m = Record(0, 4);
  m.joint = JointKind::linear;
  const Estimate estimate = Identify(GetParam(), m, "paired", {{"law", "asymmetric"}});
  EXPECT_EQ(estimate.status, Status::not_identifiable);
  EXPECT_THAT(estimate.message, HasSubstr("coulomb_positive, coulomb_negative and gravity"));
}

TEST_P(TellingGravity, RefusesPassesThatDoNotMeet) {
  // forwards over one half of the turn, backwards over the other
  Measurements m = Record(0, 5);
  m.position = (m.velocity.array() > 0).select(Eigen::ArrayXd::Constant(m.size(), 1), 4);
  m.position.array() += Eigen::ArrayXd::LinSpaced(m.size(), 0, 2);
  const Estimate estimate = Identify(GetParam(), m, "paired");
  EXPECT_EQ(estimate.status, Status::not_identifiable);
  EXPECT_THAT(estimate.message, HasSubstr("Sweep one range in both directions"));
  EXPECT_TRUE(estimate.parameters.empty());
}

std::vector<Identifier> Able() {
  std::vector<Identifier> able;
  for (const Identifier& one : Identifiers()) {
    // whose laws can follow this joint
    if (one.options.Find<GravityOption>() && one.options.Find<LawOption>()) able.push_back(one);
  }
  return able;
}

INSTANTIATE_TEST_SUITE_P(Identifiers, TellingGravity, ::testing::ValuesIn(Able()), test::NameOf);

TEST(FitGravity, PairedFollowsWhatSinAndCosCannot) {
  const Identifier& energy_ml = FindIdentifier("energy-ml");
  const Measurements m = Record(1, 6, 2);
  const Estimate paired = Identify(energy_ml, m, "paired");
  ASSERT_EQ(paired.status, Status::ok) << paired.message;
  // noise of 0.5 N.m over 3600 samples, three times; lines miss at most 26 (2 pi/64)^2/8
  EXPECT_NEAR(paired.metrics->rmse, 0.5, 3 * 0.5 / std::sqrt(2 * 3600) + 0.031);
  const Eigen::VectorXd p = Eigen::VectorXd::LinSpaced(50, 0, 6);
  const Eigen::VectorXd truth =
      8 * p.array().sin() - 3 * p.array().cos() + 2 * (3 * p).array().sin();
  // 3600 samples over 64 knots: 0.5 / sqrt(56) at each, four times, and the lines
  EXPECT_LT((paired.gravity->Torque(p) - truth).cwiseAbs().maxCoeff(), 4 * 0.5 / 7.5 + 0.031);
  ExpectSameFriction(paired, Identify(energy_ml, Record(0, 6), "none"));
}

TEST(FitGravity, IsHeldOutTogetherWithFriction) {
  const Identifier& energy_ml = FindIdentifier("energy-ml");
  const Measurements m = Record(1, 7);
  const Selection selection = SelectMoving(m);
  for (const char* gravity : {"sincos", "paired"}) {
    const auto held =
        HoldOut(energy_ml,
                {Prepare(m, selection), energy_ml.options.Read({{"gravity", gravity}}), {}}, 0.3)
            .metrics;
    ASSERT_TRUE(held);
    // noise of 0.5 N.m; parameters of the first part cost less than a tenth of it
    EXPECT_NEAR(held->rmse, 0.5, 0.05) << gravity;
  }
}

TEST(RemedyForNonDissipative, NamesWhatTheFitDoesNotHold) {
  EXPECT_EQ(RemedyForNonDissipative("viscous_coulomb", FittedGravity::none),
            "try --identifier energy-ml --set law=asymmetric");
  EXPECT_THAT(RemedyForNonDissipative("viscous_coulomb", FittedGravity::sincos),
              HasSubstr("law=asymmetric --gravity sincos"));
  EXPECT_THAT(RemedyForNonDissipative("asymmetric", FittedGravity::none),
              HasSubstr("--gravity paired"));
  EXPECT_THAT(RemedyForNonDissipative("asymmetric", FittedGravity::paired),
              ::testing::Not(HasSubstr("try")));
}

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kSpacing = kTurn / kGravityKnots;

/// 5 sin p at every knot of the turn.
GravityModel WholeTurn() {
  GravityModel gravity{GravityKind::paired, {}, Eigen::VectorXd(kGravityKnots)};
  for (int i = 0; i < kGravityKnots; ++i) {
    gravity.knots.push_back(i);
    gravity.values[i] = 5 * std::sin(i * kSpacing);
  }
  return gravity;
}

TEST(Gravity, BySinAndCosIsThatFormula) {
  const GravityModel gravity{GravityKind::sincos, {}, Eigen::Vector2d(3, -2)};
  const Eigen::Vector3d p(-1, 0.4, 9);
  const Eigen::Vector3d expected = 3 * p.array().sin() - 2 * p.array().cos();
  EXPECT_LT((gravity.Torque(p) - expected).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_TRUE(gravity.Covers(1e6));
}

TEST(Gravity, OfALinearJointIsTheSameEverywhere) {
  const GravityModel gravity{GravityKind::constant, {}, Eigen::VectorXd::Constant(1, 7)};
  EXPECT_EQ(gravity.Torque(Eigen::Vector2d(-3, 8)), Eigen::Vector2d(7, 7));
}

TEST(Gravity, BetweenKnotsIsAsNearAsLinesAre) {
  const GravityModel gravity = WholeTurn();
  const Eigen::VectorXd p = Eigen::VectorXd::LinSpaced(1000, -20, 20);
  const Eigen::VectorXd error = gravity.Torque(p) - Eigen::VectorXd(5 * p.array().sin());
  // g h^2/8 of linear interpolation
  EXPECT_LT(error.cwiseAbs().maxCoeff(), 5 * kSpacing * kSpacing / 8);
  EXPECT_TRUE(gravity.Covers(-0.01) && gravity.Covers(kTurn - 0.01));
}

TEST(Gravity, IsUnknownAwayFromItsKnots) {
  const GravityModel gravity{GravityKind::paired, {0, 1, 5, 63}, Eigen::Vector4d(1, 2, 3, 4)};
  EXPECT_TRUE(gravity.Covers(0.5 * kSpacing));
  EXPECT_TRUE(gravity.Covers(-0.5 * kSpacing)) << "across the end of the turn";
  EXPECT_TRUE(gravity.Covers(kTurn + 0.5 * kSpacing));
  EXPECT_FALSE(gravity.Covers(1.5 * kSpacing));
  EXPECT_FALSE(gravity.Covers(5.5 * kSpacing));
  const Eigen::VectorXd torque = gravity.Torque(Eigen::Vector2d(0.5, -0.5) * kSpacing);
  EXPECT_NEAR(torque[0], 1.5, 1e-12);
  EXPECT_NEAR(torque[1], 2.5, 1e-12);
}

TEST(Gravity, ComesBackFromJson) {
  for (const GravityModel& gravity :
       {GravityModel{GravityKind::sincos, {}, Eigen::Vector2d(3, -2)}, WholeTurn(),
        GravityModel{GravityKind::paired, {2, 3, 63}, Eigen::Vector3d(1, 2, 3)},
        GravityModel{GravityKind::constant, {}, Eigen::VectorXd::Constant(1, 7)}}) {
    GravityModel back;
    ReadValue(ParseJsonNode(WriteValue(gravity).dump(), "estimate.json"), &back, {});
    EXPECT_EQ(back.kind, gravity.kind);
    EXPECT_EQ(back.knots, gravity.knots);
    EXPECT_EQ(back.values, gravity.values);
  }
}

TEST(Gravity, RefusesJsonThatIsNone) {
  test::ExpectRefused(
      {{"3", "estimate.json", "map"},
       {R"({"kind": "sincoss", "sine": 1, "cosine": 2})", "estimate.json", "'sincos'"},
       {R"({"kind": "sincos", "sine": 1})", "estimate.json", "'cosine'"},
       {R"({"kind": "paired", "position": [0], "torque": [1, 2]})", "estimate.json", "torque"},
       {R"({"kind": "paired", "position": [], "torque": []})", "estimate.json", "position"},
       {R"({"kind": "paired", "position": [0.05], "torque": [1]})", "estimate.json", "0.05"}},
      [](const std::string& text) {
        GravityModel gravity;
        ReadValue(ParseJsonNode(text, "estimate.json"), &gravity, {});
      });
}

}  // namespace
}  // namespace warmjoint
