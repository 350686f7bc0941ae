// <warmjoint/compensate.h> against the forward model: every law, heat, load and maps of each kind.
#include "models/friction/compensator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "models/friction/friction_json.h"
#include "models/friction/joint_friction.h"
#include "models/friction/parameter_rows.h"
#include "tests/support/golden.h"

namespace warmjoint {
namespace {

using Eigen::Index;

constexpr double kTurn = 6.283185307179586;

/// Weights from -1 to 1.
FrictionMap WithWeights(FrictionMap map) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> weight(-1, 1);
  map.weights.resize(map.size());
  for (double& one : map.weights) one = weight(random);
  return map;
}

/// Maps over each quantity, of each kind of kernel, with each factor.
std::vector<FrictionMap> AllMaps() {
  const MapAxis position{MapQuantity::position, EvenAxis(-1, 1, 7)};
  const MapAxis motor{MapQuantity::motor_position, CircleAxis(kTurn, 9)};
  const MapAxis velocity{MapQuantity::velocity, SpeedAxis(0.1, 0.9, 4)};
  const MapAxis energy{MapQuantity::energy, EvenAxis(-4, 0, 3)};
  const MapAxis load{MapQuantity::load, EvenAxis(-20, 20, 5)};
  std::vector<FrictionMap> maps{
      WithWeights({{position}, KernelKind::normalised, {}, MapFactor::one}),
      WithWeights({{motor, velocity}, KernelKind::plain, {}, MapFactor::one}),
      WithWeights({{energy, load}, KernelKind::normalised, {}, MapFactor::direction}),
      WithWeights({{position, motor, energy}, KernelKind::plain, {}, MapFactor::velocity}),
  };
  return maps;
}

/// A friction of a law with heat and all maps, its parameters from 0.1 on and apart.
Friction EverythingOf(const Law& law) {
  Friction friction;
  friction.law = law.name;
  double next = 12;
  for (const ParameterInfo& info : law.parameters) {
    friction.parameters[std::string(info.name)] = info.part == LawPart::rest_level ? 25 : next;
    next += 1.5;
  }
  if (friction.parameters.contains("stribeck_velocity")) {
    friction.parameters["stribeck_velocity"] = 0.2;
  }
  if (friction.parameters.contains("stribeck_exponent")) {
    friction.parameters["stribeck_exponent"] = 1.3;
  }
  friction.thermal = Thermal{-0.4, 300};
  friction.second_thermal = Thermal{-0.1, 2000};
  friction.level_per_temperature = -0.05;
  if (PlaceOf(LawPart::slope, law)) friction.viscous_per_energy = 0.2;
  friction.load_gain = 0.05;
  friction.gear = 12.5;
  friction.maps = AllMaps();
  CheckFriction(friction);
  return friction;
}

/// The joint at that place, with the whole friction as its output.
wj_joint JointAt(const CompensatorNumbers& numbers, double position, double load, double energy) {
  wj_joint joint;
  wj_begin(&joint, &numbers.numbers());
  joint.settings.share = 1;
  joint.at.position = position;
  joint.at.load = load;
  joint.state.energy = energy;
  return joint;
}

TEST(Compensator, SlidesAsEveryLawDoes) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (const Law& law : Laws()) {
    const Friction friction = EverythingOf(law);
    const CompensatorNumbers numbers(friction);
    const JointFriction model(friction);
    for (int i = 0; i < 200; ++i) {
      const double position = 3 * unit(random), load = 30 * unit(random), v = 1.2 * unit(random);
      const double energy = 2 * unit(random) - 2;
      wj_joint joint = JointAt(numbers, position, load, energy);
      const double force = model.SlidingForce(v, {position, energy, load});
      ASSERT_GT(force * v, 0) << law.name;
      ASSERT_NEAR(wj_step(&joint, v, NAN, 0), force, 1e-12 * (1 + std::abs(force))) << law.name;
      // the motor's own angle, where it is measured
      joint.at.motor_position = 100 * unit(random);
      const JointPlace place{position, energy, load, joint.at.motor_position};
      ASSERT_NEAR(wj_step(&joint, v, NAN, 0), model.SlidingForce(v, place), 1e-11) << law.name;
    }
  }
}

TEST(Compensator, BrakesLessBelowALevelOfZero) {
  Friction friction{"viscous_coulomb", {{"viscous", 5}, {"coulomb", 2}}, Thermal{-1, 100}};
  const CompensatorNumbers numbers(friction);
  JointFriction model(friction);
  model.SetTimestep(0.001);
  for (const double energy : {-1.0, -3.0, -9.0}) {
    wj_joint joint = JointAt(numbers, 0, 0, energy);
    const FrictionStep step = model.Step({0, energy}, {.velocity = 0.5, .inertia = 1e6});
    EXPECT_NEAR(wj_step(&joint, 0.5, NAN, 0), step.force, 1e-12) << energy;
  }
}

TEST(Compensator, FollowsARecordingWithMaps) {
  // two hours of motion with rests, surroundings and load, each sample .1 s
  Friction friction = EverythingOf(*FindLaw("asymmetric_stribeck"));
  JointTrajectory motion;
  const Index n = 20000;
  motion.time = Eigen::VectorXd::LinSpaced(n, 0, 0.1 * (n - 1));
  motion.step = 0.1;
  motion.velocity = (motion.time.array() * 0.31).sin() * 0.8;
  for (Index i = 0; i < n; i += 7) motion.velocity[i] = 0;
  motion.position = (motion.time.array() * 0.11).sin();
  motion.load = (motion.time.array() * 0.07).cos() * 20;
  motion.ambient_rise = (motion.time.array() * 1e-3).sin() * 8;
  const Prediction predicted = AlongMotion(friction).Predict(motion, {-0.5});

  Compensator compensator(friction, {}, {.share = 1});
  compensator.joint().state.energy = -0.5;
  const Compensated compensated = CompensateAlong(compensator, motion);
  EXPECT_LT((compensated.compensation - predicted.force).cwiseAbs().maxCoeff(), 1e-11);
  EXPECT_LT((compensated.energy - predicted.energy).cwiseAbs().maxCoeff(), 1e-11);
}

TEST(Compensator, GoesOnInACopyAndFromItsMemory) {
  const Friction friction = EverythingOf(*FindLaw("stribeck"));
  Compensator first(friction, {.noise = 0.4});
  const auto step = [](Compensator& one, int i) {
    return wj_step(&one.joint(), std::sin(0.1 * i), 18 * std::sin(0.1 * i), 0.01);
  };
  for (int i = 0; i < 1000; ++i) step(first, i);
  Compensator copy = first, other(friction, {.noise = 0.4});
  other.Remember(first.Memory());
  for (int i = 1000; i < 1500; ++i) {
    const double torque = step(first, i);
    ASSERT_EQ(step(copy, i), torque);
    ASSERT_EQ(step(other, i), torque);
  }
}

}  // namespace
}  // namespace warmjoint
