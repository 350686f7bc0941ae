#include "models/friction/joint_friction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "models/foundation/random_stream.h"
#include "models/friction/bristle.h"
#include "models/friction/friction_json.h"

namespace warmjoint {
namespace {

Friction AsymmetricFriction(double kv, double positive, double negative) {
  return {"asymmetric",
          {{"viscous", kv}, {"coulomb_positive", positive}, {"coulomb_negative", negative}},
          {}};
}

constexpr double kInertia = 0.25;  // kg.m^2
constexpr double kStep = 0.001;    // s

JointFriction Make(const Friction& friction) {
  JointFriction joint(friction);
  joint.SetTimestep(kStep);
  return joint;
}

FrictionStep Step(const JointFriction& joint, const FrictionState& state, double v) {
  return joint.Step(state, {.velocity = v, .inertia = kInertia});
}

TEST(JointFriction, HoldsWithoutLossAndWithoutDriftBelowItsLevel) {
  const JointFriction joint = Make(AsymmetricFriction(0.7, 3, 5));
  FrictionStep step = Step(joint, {2.9, 0}, 0);
  EXPECT_EQ(step.force, 2.9);
  EXPECT_EQ(step.next.bristle, 2.9);
  EXPECT_EQ(step.loss, 0);
  step = Step(joint, {-4.9, 0}, 0);
  EXPECT_EQ(step.force, -4.9);
}

TEST(JointFriction, LetsGoWhereWarmingLowersTheLevelBelowTheLoad) {
  const JointFriction joint = Make(AsymmetricFriction(0, 3, 5));
  const FrictionStep step = Step(joint, {2.9, -1}, 0);
  EXPECT_EQ(step.force, 2.0);
  EXPECT_EQ(step.next.bristle, 2.0);
}

TEST(JointFriction, TakesALevelBelowZeroFromTheViscousForce) {
  // kc + E = -2: at 4 rad/s the viscous 0.7 * 4 leaves 0.8; at 2 rad/s nothing is left
  const JointFriction joint = Make(AsymmetricFriction(0.7, 3, 3));
  FrictionStep step = Step(joint, {0, -5}, 4);
  EXPECT_NEAR(step.force, 0.8, 1e-15);
  EXPECT_FALSE(step.drives_joint);
  EXPECT_NEAR(step.loss, 3.2, 1e-14);
  step = Step(joint, {0, -5}, -2);
  EXPECT_EQ(step.force, 0);
  EXPECT_TRUE(step.drives_joint);
  EXPECT_EQ(step.loss, 0);
}

/// A map over one or two quantities whose weights may well push.
FrictionMap DrawMap(RandomStream& random) {
  const std::vector<MapAxis> choices{
      {MapQuantity::position, EvenAxis(-1, 1, 9)},
      {MapQuantity::motor_position, CircleAxis(6.283185307179586, 12)},
      {MapQuantity::velocity, SpeedAxis(0.05, 0.5, 3)},
      {MapQuantity::energy, EvenAxis(-2, 2, 3)},
      {MapQuantity::load, EvenAxis(-5, 5, 4)}};
  FrictionMap map;
  const auto first = static_cast<size_t>(random.Uniform(0, 5));
  map.axes = {choices[first]};
  if (random.Uniform(0, 1) < 0.5) map.axes.push_back(choices[(first + 2) % 5]);
  map.kernels = random.Uniform(0, 1) < 0.5 ? KernelKind::plain : KernelKind::normalised;
  map.factor = std::array{MapFactor::one, MapFactor::direction,
                          MapFactor::velocity}[static_cast<size_t>(random.Uniform(0, 3))];
  for (size_t i = 0; i < map.size(); ++i) map.weights.push_back(random.Uniform(-3, 3));
  return map;
}

/// A law of the list with parameters drawn within their bounds.
Friction DrawLaw(RandomStream& random) {
  const Law& law =
      Laws()[static_cast<size_t>(random.Uniform(0, static_cast<double>(Laws().size())))];
  Friction friction;
  friction.law = law.name;
  for (const ParameterInfo& info : law.parameters) {
    friction.parameters[std::string(info.name)] =
        random.Uniform(std::max(info.lower, 0.01), std::min(info.upper, 3.0));
  }
  if (friction.parameters.contains("static")) {
    friction.parameters["static"] += friction.parameters["coulomb"];
  }
  if (friction.parameters.contains("bristle_stiffness")) {
    friction.parameters["bristle_stiffness"] *= 1e4;
  }
  friction.thermal = Thermal{random.Uniform(-2, 2), random.Uniform(0.05, 5)};
  if (random.Uniform(0, 1) < 0.5) friction.second_thermal = Thermal{random.Uniform(-1, 1), 0.02};
  friction.load_gain = random.Uniform(0, 0.5);
  friction.level_per_temperature = 0.1 * friction.thermal->gain;
  friction.gear = random.Uniform(1, 50);
  for (double left = random.Uniform(0, 3); left > 1; --left)
    friction.maps.push_back(DrawMap(random));
  CheckFriction(friction, {"draw"});
  return friction;
}

TEST(JointFriction, NeverGivesEnergyOverRandomLawsAndMotions) {
  for (std::uint64_t run = 0; run < 1000; ++run) {
    RandomStream random({7, run}, Stream::test);
    const Friction friction = DrawLaw(random);
    const JointFriction joint = Make(friction);
    const Bristle bristle = joint.own_bristle()
                                ? LimitBristle(*joint.own_bristle(), kInertia, kStep)
                                : ScaleBristle(UnitBristle(kStep), kInertia);

    // a wild motion: white acceleration, pulled back to rest
    FrictionState state;
    JointMotion motion{.inertia = kInertia};
    double absorbed = 0;  // J
    double scale = 0;     // J moved to and fro
    for (int i = 0; i < 2000; ++i) {
      const double v = motion.velocity = 0.97 * motion.velocity + 0.1 * random.Normal();
      motion.position += v * kStep;
      motion.load = 5 * std::sin(0.01 * i);
      motion.ambient_rise = 10 * std::cos(0.003 * i);
      const FrictionStep step = joint.Step(state, motion);
      absorbed += step.force * v * kStep;
      scale += std::abs(step.force * v * kStep);
      state = step.next;
      const double stored = state.bristle * state.bristle / (2 * bristle.stiffness);
      // what is stored was absorbed before; one rounding in each of 2000 sums
      ASSERT_GE(absorbed - stored, -1e-13 * scale)
          << friction.law << " run " << run << " step " << i;
      ASSERT_GE(step.loss, 0);
    }
  }
}

TEST(JointFriction, EveryLawSlidesAtItsSteadyForce) {
  for (const Law& law : Laws()) {
    Friction friction;
    friction.law = law.name;
    double value = 2;
    for (const ParameterInfo& info : law.parameters) {
      friction.parameters[std::string(info.name)] = value += 0.3;
    }
    if (friction.parameters.contains("static")) friction.parameters["static"] = 5;
    const JointFriction joint = Make(friction);
    for (const double v : {-3.0, -0.3, 0.3, 3.0}) {
      FrictionStep step;
      // 40 rad of travel: a bristle of 3.7 N.m/rad has relaxed to e^-24 of a level of 6.1 N.m
      for (int i = 0; i * kStep * std::abs(v) < 40; ++i) step = Step(joint, step.next, v);
      EXPECT_NEAR(step.force, joint.SlidingForce(v, {}), 1e-8) << law.name << " at " << v;
      EXPECT_NEAR(step.loss, Loss(v, step.force), 1e-8) << law.name << " at " << v;
    }
  }
}

Friction Sticky() { return {"stiction", {{"viscous", 0}, {"coulomb", 3}, {"static", 5}}, {}}; }

TEST(JointFriction, BreaksAwayAtTheStaticLevelAndSlidesAtCoulombUntilItStops) {
  const JointFriction joint = Make(Sticky());
  FrictionStep step = Step(joint, {4.9}, 1e-9);
  EXPECT_GT(step.force, 4.89) << "held above coulomb";
  EXPECT_EQ(step.next.slip, 0);

  // pulled on, it breaks away at 5 and slides at 3
  step = Step(joint, step.next, 0.1);
  EXPECT_EQ(step.force, 5);
  EXPECT_EQ(step.next.slip, 1);
  step = Step(joint, step.next, 0.1);
  EXPECT_EQ(step.force, 3);
  EXPECT_EQ(step.next.bristle, 3);
  EXPECT_NEAR(step.loss, 0.3, 1e-15);

  // the stop restores the static level: 25000 N.m/rad over 7e-5 rad
  step = Step(joint, step.next, 0);
  EXPECT_EQ(step.next.slip, 0);
  for (int i = 0; i < 70; ++i) step = Step(joint, step.next, 1e-3);
  EXPECT_GT(step.force, 4.5);
}

TEST(JointFriction, DahlApproachesItsLevelWithTravelExactlyAtAnyStep) {
  const Friction friction{"dahl", {{"coulomb", 4}, {"bristle_stiffness", 100}}, {}};
  for (const double h : {0.0005, 0.002}) {
    JointFriction joint(friction);
    joint.SetTimestep(h);
    FrictionStep step;
    const double v = 0.5;
    for (int i = 1; i <= 100; ++i) {
      step = Step(joint, step.next, v);
      // F = kc (1 - exp(-sigma0 x / kc)), rounding of a hundred steps
      EXPECT_NEAR(step.force, 4 * -std::expm1(-100 * v * i * h / 4), 1e-13);
    }
  }
}

TEST(JointFriction, SlidesWithItsMapsLoadAndSlopeOverEnergy) {
  Friction friction = AsymmetricFriction(0.7, 3, 5);
  friction.thermal = Thermal{-1, 100};
  friction.viscous_per_energy = 0.2;
  friction.load_gain = 0.1;
  // 1.5 N.m at any position, the same in both directions
  friction.maps = {
      {{{MapQuantity::position, EvenAxis(-1, 1, 3)}}, KernelKind::normalised, {1.5, 1.5, 1.5}}};
  CheckFriction(friction, {"test"});
  const JointFriction joint = Make(friction);
  const JointPlace place{0.3, -2, -4};
  // slope 0.7 - 0.4; levels 3 and 5, each - 2 + 0.4
  EXPECT_NEAR(joint.SlidingForce(0.5, place), 0.3 * 0.5 + 1.4 + 1.5, 1e-14);
  EXPECT_NEAR(joint.SlidingForce(-0.5, place), -0.3 * 0.5 - 3.4 + 1.5, 1e-14);
}

TEST(JointFriction, HoldsWithinTheIntervalThatAMapShifts) {
  Friction friction = AsymmetricFriction(0, 3, 3);
  friction.maps = {
      {{{MapQuantity::position, EvenAxis(-1, 1, 3)}}, KernelKind::normalised, {2, 2, 2}}};
  const JointFriction joint = Make(friction);
  // 3 + 2 forwards, 3 - 2 backwards
  EXPECT_EQ(Step(joint, {4.9}, 0).force, 4.9);
  EXPECT_NEAR(Step(joint, {5.1}, 0).force, 5, 1e-15);
  EXPECT_NEAR(Step(joint, {-1.1}, 0).force, -1, 1e-15);
}

TEST(JointFriction, SetsANumberThatWasSetTo0Again) {
  Friction friction = AsymmetricFriction(0, 3, 3);
  friction.load_gain = 0.2;
  JointFriction joint = Make(friction);
  const auto place = joint.FindNumber("load_gain");
  ASSERT_TRUE(place);
  for (const double gain : {0.0, 0.1}) {
    EXPECT_TRUE(joint.SetNumber(*place, gain));
    EXPECT_EQ(joint.Number(*place), gain);
    EXPECT_EQ(joint.FindNumber("load_gain"), place);
  }
}

TEST(JointFriction, StatesAreThoseThatTheLawNeeds) {
  EXPECT_EQ(StateOf(AsymmetricFriction(1, 1, 1)).size(), 2);
  ASSERT_EQ(StateOf(Sticky()).size(), 3);
  EXPECT_EQ(StateOf(Sticky())[2].name, "slip");
  Friction warm = Sticky();
  warm.thermal = warm.second_thermal = Thermal{-1, 100};
  ASSERT_EQ(StateOf(warm).size(), 4);
  EXPECT_EQ(StateOf(warm)[2].name, "second energy");
}

}  // namespace
}  // namespace warmjoint
