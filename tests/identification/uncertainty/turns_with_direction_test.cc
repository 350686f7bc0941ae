#include "identification/uncertainty/turns_with_direction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/coloured_noise.h"

namespace warmjoint {
namespace {

using test::Coloured;

TEST(TurnsWithDirection, IsSaidOfFrictionAndNotOfTorque) {
  Eigen::VectorXd velocity(1000);
  for (Eigen::Index i = 0; i < 1000; ++i) velocity[i] = i / 20 % 2 == 0 ? 1 : -1;
  int turning = 0, found = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Eigen::VectorXd noise = Coloured(1000, 0.9, seed);
    // colour of the torque seldom turns, colour of the friction does
    turning += *TurnsWithDirection(noise, velocity);
    found += *TurnsWithDirection(Coloured(1000, 0.99, seed).cwiseProduct(velocity), velocity);
  }
  EXPECT_LE(turning, 1);  // three deviations to one side: one in 700
  EXPECT_GE(found, 90);   // 50 runs whose means correlate by exp(-0.2): 5 deviations on average
}

TEST(TurnsWithDirection, NeedsNineChangesOfDirection) {
  const auto turns = [](Eigen::Index changes) {
    Eigen::VectorXd velocity(changes + 1);
    for (Eigen::Index i = 0; i <= changes; ++i) velocity[i] = i % 2 == 0 ? 1 : -1;
    return TurnsWithDirection(3 * velocity, velocity);
  };
  EXPECT_FALSE(turns(8));
  EXPECT_EQ(turns(9), false);  // all of nine are three deviations, and not more
  EXPECT_EQ(turns(10), true);
  EXPECT_FALSE(TurnsWithDirection(Eigen::VectorXd::Ones(50), Eigen::VectorXd::Ones(50)));
}

}  // namespace
}  // namespace warmjoint
