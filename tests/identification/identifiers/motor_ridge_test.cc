#include <gmock/gmock.h>

#include "tests/support/judging.h"
#include "tests/support/travelling.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

/// 10 min at 20 Hz of a joint with a gear of 100.
Measurements Geared(std::vector<FrictionMap> maps, double noise) {
  Friction friction{"viscous_coulomb", {{"viscous", 0.5}, {"coulomb", 2}}, {}, 0, 100};
  friction.maps = std::move(maps);
  return test::RecordTravel(friction, 0.05, test::Travel(12000, 0.05, 1, {0.31, 0.57, 0.83}), 0,
                            noise, 0, 9);
}

Estimate Identify(const Measurements& m) {
  return test::Fitted("motor-ridge", m, {{"width", "1"}, {"arm_kernels", "10"}});
}

TEST(MotorRidge, FindsTheMultiplesOfTheMotorsTurn) {
  const Estimate estimate =
      Identify(Geared({test::MotorRipple(2, 0.2), test::MotorRipple(6, 0.1)}, 0.1));
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  const std::string two_and_six = "0\\.[0-9]+ N.m at 2 a turn, 0\\.[0-9]+ N.m at 6 a turn";
  EXPECT_THAT(estimate.message,
              ::testing::ContainsRegex("v > 0: " + two_and_six +
                                       "; motor ripple for v < 0: " + two_and_six));
  EXPECT_NEAR(estimate.metrics->rmse, 0.1, 0.1 * 0.05);
}

TEST(MotorRidge, FindsNoRippleInATorqueThatIsPeriodicInTimeOrVariesOverTheJoint) {
  Measurements periodic = Geared({}, 0.1);
  periodic.torque.array() += 0.3 * (2 * std::numbers::pi / 7 * periodic.time.array() + 0.4).sin();
  const Estimate estimate = Identify(periodic);
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  EXPECT_THAT(estimate.message, HasSubstr("v > 0: none above the noise"));
  EXPECT_THAT(estimate.message, HasSubstr("v < 0: none above the noise"));
  EXPECT_THAT(Identify(Geared({test::PositionLevel(1, 0.3)}, 0.1)).message,
              HasSubstr("v > 0: none above the noise"));
}

TEST(MotorRidge, SaysThatItsMapLacksKernelsOverSpeed) {
  const auto answer = [](double change, std::uint64_t seed) {
    Measurements m = Geared({test::MotorRipple(2, 0.2)}, 0.1);
    test::AddNoise(m, 0.1, 0, seed);
    for (Eigen::Index i = 0; i < m.size(); ++i) {
      const double faster = std::abs(m.velocity[i]) / 0.57 - 1;
      m.torque[i] += change * faster * std::sin(200 * m.position[i]);
    }
    return test::Answer("motor-ridge", m,
                        {{"width", "1"}, {"arm_kernels", "10"}, {"velocity_kernels", "1"}});
  };
  EXPECT_TRUE(test::Asked(answer(0.3, 1), "motor_angle_by_speed").rejected);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    EXPECT_FALSE(test::Asked(answer(0, seed), "motor_angle_by_speed").rejected) << seed;
  }
}

}  // namespace
}  // namespace warmjoint
