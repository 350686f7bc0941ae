#include "identification/gravity.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "models/foundation/serialize.h"
#include "tests/support/refusal.h"

namespace warmjoint {
namespace {

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
