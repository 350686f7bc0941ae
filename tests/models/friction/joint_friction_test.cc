#include "models/friction/joint_friction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

FrictionDescription Asymmetric(double kv, double positive, double negative) {
  FrictionDescription friction;
  friction.law = "asymmetric";
  friction.parameters = {
      {"viscous", kv}, {"coulomb_positive", positive}, {"coulomb_negative", negative}};
  return friction;
}

constexpr double kInertia = 0.25;  // kg.m^2
constexpr double kStep = 0.001;    // s

JointFriction Make(const FrictionDescription& friction) {
  JointFriction joint(friction);
  joint.SetTimestep(kStep);
  return joint;
}

/// Steps at constant velocity until the bristle has yielded.
FrictionStep Slide(const JointFriction& joint, double v, double energy) {
  FrictionStep step;
  FrictionState state{0, energy};
  for (int i = 0; i < 10000 && !(step.loss > 0 && i > 1000); ++i) {
    step = joint.Step(state, v, kInertia);
    state.bristle = step.next.bristle;
  }
  return step;
}

TEST(JointFriction, SlidesAtTheForceOfEquation20) {
  const JointFriction joint = Make(Asymmetric(0.7, 3, 5));
  for (const double v : {-2.0, -0.1, 0.1, 2.0}) {
    for (const double energy : {-2.0, 0.0, 1.5}) {
      const FrictionStep step = Slide(joint, v, energy);
      // one rounding in each of three sums
      EXPECT_NEAR(step.force, joint.SlidingForce(v, energy), 1e-15 * 10);
      EXPECT_NEAR(step.loss, Loss(v, joint.SlidingForce(v, energy)), 1e-14);
    }
  }
}

TEST(JointFriction, HoldsWithoutLossAndWithoutDriftBelowItsLevel) {
  const JointFriction joint = Make(Asymmetric(0.7, 3, 5));
  FrictionStep step = joint.Step({2.9, 0}, 0, kInertia);
  EXPECT_EQ(step.force, 2.9);
  EXPECT_EQ(step.next.bristle, 2.9);
  EXPECT_EQ(step.loss, 0);
  step = joint.Step({-4.9, 0}, 0, kInertia);
  EXPECT_EQ(step.force, -4.9);
}

TEST(JointFriction, LetsGoWhereWarmingLowersTheLevelBelowTheLoad) {
  const JointFriction joint = Make(Asymmetric(0, 3, 5));
  const FrictionStep step = joint.Step({2.9, -1}, 0, kInertia);
  EXPECT_EQ(step.force, 2.0);
  EXPECT_EQ(step.next.bristle, 2.0);
}

TEST(JointFriction, TakesALevelBelowZeroFromTheViscousForce) {
  // kc + E = -2: at 4 rad/s the viscous 0.7 * 4 leaves 0.8; at 2 rad/s nothing is left
  const JointFriction joint = Make(Asymmetric(0.7, 3, 3));
  FrictionStep step = joint.Step({0, -5}, 4, kInertia);
  EXPECT_NEAR(step.force, 0.8, 1e-15);
  EXPECT_FALSE(step.feeds_itself);
  EXPECT_NEAR(step.loss, 3.2, 1e-14);
  step = joint.Step({0, -5}, -2, kInertia);
  EXPECT_EQ(step.force, 0);
  EXPECT_TRUE(step.feeds_itself);
  EXPECT_EQ(step.loss, 0);
}

TEST(JointFriction, NeverGivesEnergyOverRandomLawsAndMotions) {
  for (std::uint64_t run = 0; run < 1000; ++run) {
    RandomStream random({7, run}, Stream::test);
    FrictionDescription friction =
        Asymmetric(random.Uniform(0, 2), random.Uniform(0, 10), random.Uniform(0, 10));
    friction.thermal = Thermal{random.Uniform(-2, 2), random.Uniform(0.05, 5)};
    const JointFriction joint = Make(friction);
    const double stiffness = MakeBristle(kInertia, kStep).stiffness;

    // a wild motion: white acceleration, pulled back to rest
    FrictionState state;
    double v = 0;
    double absorbed = 0;  // J
    double scale = 0;     // J moved to and fro
    for (int i = 0; i < 2000; ++i) {
      v = 0.97 * v + 0.1 * random.Normal();
      const FrictionStep step = joint.Step(state, v, kInertia);
      absorbed += step.force * v * kStep;
      scale += std::abs(step.force * v * kStep);
      state = step.next;
      const double stored = state.bristle * state.bristle / (2 * stiffness);
      // what is stored was absorbed before; one rounding in each of 2000 sums
      ASSERT_GE(absorbed - stored, -1e-13 * scale) << "run " << run << " step " << i;
      ASSERT_GE(step.loss, 0);
    }
  }
}

}  // namespace
}  // namespace warmjoint
