#include "sim/plant/ideal_friction.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/shared_data.h"

namespace warmjoint {
namespace {

FrictionDescription Warm(double kv, double kc, double k, double tau) {
  return {"viscous_coulomb", {{"viscous", kv}, {"coulomb", kc}}, Thermal{k, tau}};
}

Eigen::VectorXd Vector(const nlohmann::json& numbers) {
  Eigen::VectorXd vector(static_cast<Eigen::Index>(numbers.size()));
  for (size_t i = 0; i < numbers.size(); ++i) vector[static_cast<Eigen::Index>(i)] = numbers[i];
  return vector;
}

/// Closed forms hold to 1e-12 relative (golden/README); the largest value sets the scale.
void ExpectClose(const Eigen::VectorXd& value, const Eigen::VectorXd& expected) {
  ASSERT_EQ(value.size(), expected.size());
  EXPECT_LE((value - expected).lpNorm<Eigen::Infinity>(),
            1e-12 * expected.lpNorm<Eigen::Infinity>());
}

TEST(IdealFriction, RunsThroughRestsAndReversalsAsTheGoldenLoop) {
  WARMJOINT_NEED_SHARED("golden/golden.json");
  const auto& golden = test::Golden()["closed_sim"];
  const Thermal thermal = Continuous({golden["ke"], golden["te"]}, 1.0);
  const auto friction = Warm(golden["kv"], golden["kc"], thermal.gain, thermal.time_constant);
  const auto history = SimulateFriction(friction, golden["E0"], 1.0, {Vector(golden["v"])}, {});
  ExpectClose(history.force, Vector(golden["F"]));
  ExpectClose(history.loss, Vector(golden["W"]));
  ExpectClose(history.energy, Vector(golden["E"]));
}

TEST(IdealFriction, WarmsAtConstantSpeedAsTheGoldenClosedForm) {
  WARMJOINT_NEED_SHARED("golden/golden.json");
  const auto& golden = test::Golden()["constant_speed"];
  const double v = golden["v"];
  const auto history =
      SimulateFriction(Warm(5, 15, -3, 600), 0, 1.0, {Eigen::VectorXd::Constant(3601, v)}, {});
  for (size_t i = 0; i < golden["k"].size(); ++i) {
    // a recursion of n steps rounds n times
    const int step = golden["k"][i];
    const double expected = golden["E_closed"][i];
    EXPECT_NEAR(history.energy[step], expected, (1e-12 + 1e-15 * step) * std::abs(expected));
  }
}

TEST(IdealFriction, CoolsAtRestWithItsOwnTimeConstant) {
  const auto history =
      SimulateFriction(Warm(5, 15, -3, 600), -8, 1.0, {Eigen::VectorXd::Zero(601)}, {});
  EXPECT_NEAR(history.energy[600], -8 * std::exp(-1.0), 1e-12 * 8);
  EXPECT_EQ(history.force.lpNorm<Eigen::Infinity>(), 0);
}

TEST(IdealFriction, KeepsTheLevelWithoutAThermalPart) {
  FrictionDescription friction = Warm(5, 15, 0, 1);
  friction.thermal.reset();
  const auto history =
      SimulateFriction(friction, 0, 1.0, {Eigen::VectorXd::Constant(100, 0.5)}, {});
  EXPECT_EQ(history.force[99], 17.5);
  EXPECT_EQ(history.energy[99], 0);
}

TEST(IdealFriction, RefusesWhatFeedsItself) {
  // above 1 rad/s for minutes, then slow: E = -3 v F0 / (1 + 3 v) exceeds 15 + 5 * 0.05 in size
  Eigen::VectorXd velocity(4000);
  velocity << Eigen::VectorXd::Constant(3000, 2.0), Eigen::VectorXd::Constant(1000, 0.05);
  try {
    SimulateFriction(Warm(5, 15, -3, 600), 0, 1.0, {velocity}, {"hot"});
    FAIL() << "self-feeding friction was simulated";
  } catch (const BadInput& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("hot: at 3000 s friction feeds itself"));
    EXPECT_THAT(error.what(), testing::HasSubstr("move slower before"));
  }
}

}  // namespace
}  // namespace warmjoint
