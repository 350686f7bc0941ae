#include "identification/lack_of_fit/other_units.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "tests/support/judging.h"

namespace warmjoint {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;  // in a radian

/// The moves of an assumption; empty where it is not made.
ParameterMoves MovesOf(const Estimate& estimate, const std::string& name) {
  const auto found = std::ranges::find(estimate.assumptions, name, &Assumption::name);
  return found == estimate.assumptions.end() ? ParameterMoves{} : found->moves;
}

double Move(const ParameterMoves& moves, const std::string& name) {
  return std::ranges::find(moves, name, &ParameterMoves::value_type::first)->second;
}

TEST(OtherUnits, ReachWhatALogInDegreesHides) {
  Measurements m = test::RecordHour(test::TableOne(), 1);
  m.position *= kDegrees;
  m.velocity *= kDegrees;
  const Estimate estimate = test::Answer("energy-ml", m);
  const ParameterMoves moves = MovesOf(estimate, "angles_in_radians");
  ASSERT_FALSE(moves.empty());
  for (const auto& [name, truth] : {std::pair{"viscous", 5.0}, std::pair{"thermal_gain", -3.0}}) {
    const double value = estimate.Find(name)->value;
    EXPECT_NEAR(value * kDegrees, truth, 0.05 * std::abs(truth));
    EXPECT_GT(Move(moves, name) / value, kDegrees - 1);
    EXPECT_LT(Move(moves, name) / value, 1.1 * kDegrees);
  }
  EXPECT_EQ(Move(moves, "coulomb"), 0);
  EXPECT_EQ(Move(moves, "thermal_time_constant"), 0);
}

TEST(OtherUnits, AreNotAskedOfASlidingJoint) {
  Measurements m = test::RecordHour(test::TableOne(), 1);
  m.joint = JointKind::linear;
  EXPECT_TRUE(MovesOf(test::Answer("energy-ml", m), "angles_in_radians").empty());
}

TEST(OtherUnits, ReachWhatASlowClockHides) {
  Measurements m = test::RecordHour(test::TableOne(), 1);
  m.time *= 0.99;
  const Estimate estimate = test::Answer("energy-ml", m);
  const EstimatedParameter& tau = *estimate.Find("thermal_time_constant");
  const double move = Move(MovesOf(estimate, "true_clock"), "thermal_time_constant");
  EXPECT_GT(move, 0.01 * tau.value);
  EXPECT_LT(move, 0.011 * tau.value);
}

}  // namespace
}  // namespace warmjoint
