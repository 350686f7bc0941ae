#include "models/friction/along_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "models/friction/friction_json.h"
#include "tests/support/bristle_recording.h"

namespace warmjoint {
namespace {

using Eigen::Index;

constexpr Index kSamples = 400;

/// Every law with values that differ, static above coulomb, stiff where it has a bristle.
Friction SomeFriction(const Law& law) {
  Friction friction;
  friction.law = law.name;
  double value = 2;
  for (const ParameterInfo& info : law.parameters) {
    friction.parameters[std::string(info.name)] = value += 0.37;
  }
  const auto set = [&](const char* name, double other) {
    if (friction.parameters.contains(name)) friction.parameters[name] = other;
  };
  set("static", 5.3);
  set("stribeck_velocity", 0.2);
  set("bristle_stiffness", 900);
  set("bristle_damping", 2);
  return friction;
}

bool HasBristle(const Law& law) { return law.pre_sliding == PreSliding::bristle; }

/// To and fro with rests, at uneven times. [kSamples]
JointTrajectory SomeTrajectory() {
  JointTrajectory trajectory;
  trajectory.time.resize(kSamples);
  trajectory.velocity.resize(kSamples);
  RandomStream random({3, 0}, Stream::test);
  double time = 0;
  for (Index i = 0; i < kSamples; ++i) {
    trajectory.time[i] = time += random.Uniform(0.2, 1.5);
    const bool rests = i / 17 % 4 == 3;
    trajectory.velocity[i] = rests ? 0 : (i / 17 % 2 ? -1 : 1) * random.Uniform(0.1, 1.2);
  }
  return trajectory;
}

/// The same with all that a joint can meet.
JointTrajectory RichTrajectory() {
  JointTrajectory trajectory = SomeTrajectory();
  trajectory.position.resize(kSamples);
  trajectory.motor_position.resize(kSamples);
  trajectory.load.resize(kSamples);
  trajectory.ambient_rise.resize(kSamples);
  RandomStream random({4, 0}, Stream::test);
  for (Index i = 0; i < kSamples; ++i) {
    trajectory.position[i] = random.Uniform(-2, 2);
    trajectory.motor_position[i] = random.Uniform(-20, 20);
    trajectory.load[i] = random.Uniform(-4, 4);
    trajectory.ambient_rise[i] = random.Uniform(-10, 10);
  }
  return trajectory;
}

/// All that a friction can have, beside its law.
Friction Rich(Friction friction) {
  friction.thermal = Thermal{-0.8, 40};
  friction.second_thermal = Thermal{-0.2, 9};
  friction.load_gain = 0.15;
  friction.level_per_temperature = -0.02;
  if (friction.parameters.contains("viscous")) friction.viscous_per_energy = 0.3;
  friction.gear = 7;
  FrictionMap over_position, over_motor;
  over_position.axes = {{MapQuantity::position, EvenAxis(-2, 2, 6)}};
  over_motor.axes = {{MapQuantity::motor_position, CircleAxis(2 * M_PI, 8)}};
  for (int i = 0; i < 6; ++i) over_position.weights.push_back(0.1 * std::cos(i));
  for (int i = 0; i < 8; ++i) over_motor.weights.push_back(0.1 * std::sin(i));
  friction.maps = {over_position, over_motor};
  CheckFriction(friction, {"rich"});
  return friction;
}

void ExpectClose(const Eigen::VectorXd& value, const Eigen::VectorXd& expected,
                 double tolerance = 1e-12) {
  ASSERT_EQ(value.size(), expected.size());
  EXPECT_LE((value - expected).lpNorm<Eigen::Infinity>(),
            tolerance * expected.lpNorm<Eigen::Infinity>());
}

Friction Warm(double kv, double kc, double k, double tau) {
  return {"viscous_coulomb", {{"viscous", kv}, {"coulomb", kc}}, Thermal{k, tau}};
}

JointTrajectory EvenTrajectory(double step, const Eigen::VectorXd& velocity) {
  JointTrajectory trajectory{
      Eigen::VectorXd::LinSpaced(velocity.size(), 0,
                                 step * static_cast<double>(velocity.size() - 1)),
      velocity};
  trajectory.step = step;
  return trajectory;
}

TEST(AlongMotion, RunsThroughRestsAndReversalsAsTheGoldenLoop) {
  const auto& golden = test::Golden()["closed_sim"];
  const Thermal thermal = Continuous({golden["ke"], golden["te"]}, 1.0);
  const AlongMotion model(Warm(golden["kv"], golden["kc"], thermal.gain, thermal.time_constant));
  const Prediction p =
      model.Predict(EvenTrajectory(1, test::ToVector(golden["v"])), {golden["E0"]});
  // closed forms hold to 1e-12 relative (golden/README); the largest value sets the scale
  ExpectClose(p.force, test::ToVector(golden["F"]));
  ExpectClose(p.loss, test::ToVector(golden["W"]));
  ExpectClose(p.energy, test::ToVector(golden["E"]));
  EXPECT_EQ(p.first_driving, p.force.size());
}

TEST(AlongMotion, WarmsAtConstantSpeedAsTheGoldenClosedForm) {
  const auto& golden = test::Golden()["constant_speed"];
  const double v = golden["v"];
  const Prediction p = AlongMotion(Warm(5, 15, -3, 600))
                           .Predict(EvenTrajectory(1, Eigen::VectorXd::Constant(3601, v)));
  for (size_t i = 0; i < golden["k"].size(); ++i) {
    // a recursion of n steps rounds n times
    const int step = golden["k"][i];
    const double expected = golden["E_closed"][i];
    EXPECT_NEAR(p.energy[step], expected, (1e-12 + 1e-15 * step) * std::abs(expected));
  }
}

TEST(AlongMotion, IsEquations19To22BitForBitForLawsWithoutABristle) {
  const JointTrajectory trajectory = SomeTrajectory();
  for (const Law& law : Laws()) {
    if (HasBristle(law)) continue;
    Friction friction = SomeFriction(law);
    friction.thermal = Thermal{-0.8, 40};
    const Prediction p = AlongMotion(friction).Predict(trajectory, {-0.3});
    EXPECT_EQ(p.bristle.size(), 0);

    // the loop as the paper writes it
    const std::vector<double> values = LawValues(friction);
    double energy = -0.3;
    for (Index i = 0; i < kSamples; ++i) {
      const double v = trajectory.velocity[i];
      const double force = law.force(v, values.data()) + Sign(v) * energy;
      const double loss = std::abs(force * v);
      ASSERT_EQ(p.force[i], force) << law.name << i;
      ASSERT_EQ(p.energy[i], energy) << law.name << i;
      ASSERT_EQ(p.loss[i], loss) << law.name << i;
      if (i + 1 == kSamples) break;
      const double h = trajectory.time[i + 1] - trajectory.time[i];
      energy = std::exp(-h / 40) * energy + -0.8 * -std::expm1(-h / 40) * loss;
    }
  }
}

TEST(AlongMotion, IsThePluginsKernelBitForBitWhereAJointSlides) {
  // with maps, load, surroundings, two stages and a slope over E
  const JointTrajectory trajectory = RichTrajectory();
  for (const Law& law : Laws()) {
    if (HasBristle(law)) continue;
    const Friction friction = Rich(SomeFriction(law));
    const Prediction p = AlongMotion(friction).Predict(trajectory, {-0.3, 0.1});
    const JointFriction joint(friction);
    double first = -0.3, second = 0.1;
    for (Index i = 0; i < kSamples; ++i) {
      const double v = trajectory.velocity[i];
      const JointPlace place{trajectory.position[i], first + second, trajectory.load[i],
                             trajectory.motor_position[i]};
      const double force = v == 0 ? 0 : joint.SlidingForce(v, place);
      ASSERT_EQ(p.force[i], force) << law.name << i;
      ASSERT_EQ(p.energy[i], first + second) << law.name << i;
      if (i + 1 == kSamples) break;
      const Heat heat = DiscretiseHeat(friction, trajectory.time[i + 1] - trajectory.time[i]);
      first = heat.First(first, {p.loss[i], trajectory.ambient_rise[i]});
      second = heat.Second(second, {p.loss[i]});
    }
    EXPECT_EQ(p.end.energy, first);
    EXPECT_EQ(p.end.second_energy, second);
  }
}

/// What the plugin's kernel makes of a motion in one direction, from a bristle that has yielded.
/// trajectory: even, its gear that of the friction.
Prediction Stepped(const Friction& friction, const JointTrajectory& trajectory) {
  JointFriction joint(friction);
  joint.SetTimestep(trajectory.step);
  const Index n = trajectory.time.size();
  Prediction p{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n), {}, n, {}};
  FrictionState state{1e6, 0, 0, 1};
  for (Index i = 0; i < n; ++i) {
    // of an inertia so large that the chosen bristle yields at once
    const FrictionStep step =
        joint.Step(state, {trajectory.position[i], trajectory.velocity[i], 1e9, trajectory.load[i],
                           trajectory.ambient_rise[i]});
    p.force[i] = step.force;
    p.loss[i] = step.loss;
    p.energy[i] = state.energy + state.second_energy;
    state = step.next;
  }
  return p;
}

JointTrajectory OneDirection() {
  JointTrajectory trajectory = RichTrajectory();
  trajectory.step = 0.5;
  trajectory.time = Eigen::VectorXd::LinSpaced(kSamples, 0, 0.5 * (kSamples - 1));
  trajectory.velocity = trajectory.velocity.array().abs() + 0.1;
  trajectory.motor_position.resize(0);
  return trajectory;
}

TEST(AlongMotion, IsTheStepOfThePlugin) {
  const JointTrajectory trajectory = OneDirection();
  for (const Law& law : Laws()) {
    if (HasBristle(law)) continue;
    const Friction friction = Rich(SomeFriction(law));
    const Prediction p = AlongMotion(friction).Predict(trajectory),
                     stepped = Stepped(friction, trajectory);
    // kv v + (g + E) against (kv v + g) + E, some roundings a step, which the loop damps
    ExpectClose(p.force, stepped.force, 1e-14);
    ExpectClose(p.loss, stepped.loss, 1e-14);
    ExpectClose(p.energy, stepped.energy, 1e-14);
  }
}

TEST(AlongMotion, BendsBristlesAsThePluginStepsThem) {
  // at a speed and a level that are constant from sample to sample both are exact
  for (const Law& law : Laws()) {
    if (!HasBristle(law)) continue;
    Friction friction = SomeFriction(law);
    friction.load_gain = 0.15;
    JointTrajectory trajectory = EvenTrajectory(0.01, Eigen::VectorXd::Constant(60, 0.05));
    trajectory.velocity[0] = -0.05;
    trajectory.load = Eigen::VectorXd::Constant(60, -3);
    const Prediction p = AlongMotion(friction).Predict(trajectory);
    JointFriction joint(friction);
    joint.SetTimestep(0.01);
    FrictionState state{p.bristle[1]};
    for (Index i = 2; i < 60; ++i) {
      state = joint.Step(state, {.velocity = 0.05, .inertia = 1e6, .load = -3}).next;
      // rounding of 60 steps at 6 N.m
      EXPECT_NEAR(p.bristle[i], state.bristle, 1e-13) << law.name << i;
    }
    EXPECT_GT(p.bristle[59], p.bristle[2] + 1) << law.name << " bends on the way";
  }
}

TEST(AlongMotion, LosesInABristleWhatItDoesNotStore) {
  // work done less load^2 / (2 sigma0), over a motion within the elastic range and beyond
  const Friction friction{"dahl", {{"coulomb", 4}, {"bristle_stiffness", 100}}, {}};
  const Index n = 20001;
  JointTrajectory trajectory{Eigen::VectorXd::LinSpaced(n, 0, 20), Eigen::VectorXd(n)};
  trajectory.velocity =
      (0.1 * trajectory.time.array()).sin() * (3 * trajectory.time.array()).cos() * 0.2;
  const Prediction p = AlongMotion(friction).Predict(trajectory);
  const double h = 1e-3;
  const Eigen::ArrayXd power = p.force.array() * trajectory.velocity.array();
  const auto integral = [h](const Eigen::ArrayXd& y) {
    return h * (y.sum() - 0.5 * (y[0] + y[y.size() - 1]));
  };
  const double stored = (std::pow(p.bristle[n - 1], 2) - std::pow(p.bristle[0], 2)) / 200;
  // the trapezoidal rule: h^2 / 12 of the second derivatives, with corners where the motion turns
  EXPECT_NEAR(integral(p.loss.array()), integral(power) - stored, 1e-5);
  EXPECT_GE(p.loss.minCoeff(), 0);
  EXPECT_GT(integral(p.loss.array()), 1);
}

TEST(AlongMotion, BendsTheBristleAsTheTorqueTells) {
  Friction friction{"dahl", {{"coulomb", 15}, {"bristle_stiffness", 2000}}, {}};
  JointTrajectory trajectory = EvenTrajectory(0.01, Eigen::VectorXd::Constant(101, 0.001));
  EXPECT_NEAR(AlongMotion(friction).Predict(trajectory).force[0], 15, 1e-12);
  trajectory.torque = Eigen::VectorXd::Constant(101, 3);
  const Prediction bent = AlongMotion(friction).Predict(trajectory);
  EXPECT_NEAR(bent.force[0], 3, 1e-12);
  // ds/dx = sigma0 (1 - s / 15), 1 mrad on; rounding of a hundred steps
  EXPECT_NEAR(bent.force[100], 15 - 12 * std::exp(-2000 * 0.001 / 15), 1e-12);
}

TEST(AlongMotion, JumpsWhereItIsToldAndCoolsFromThere) {
  const Friction friction = Warm(5, 15, -3, 600);
  JointTrajectory trajectory = EvenTrajectory(1, Eigen::VectorXd::Zero(10));
  ThermalStart start;
  start.energy = -8;
  start.jumps = {{3, 2}, {7, -1}};
  const Prediction p = AlongMotion(friction).Predict(trajectory, start);
  const auto after = [](int steps) { return std::exp(-steps / 600.0); };
  // closed forms
  EXPECT_NEAR(p.energy[2], -8 * after(2), 1e-14);
  EXPECT_NEAR(p.energy[3], -8 * after(3) + 2, 1e-14);
  EXPECT_NEAR(p.energy[9], -8 * after(9) + 2 * after(6) - after(2), 1e-14);
}

TEST(AlongMotion, IsColdAgainWhereAnotherRecordingBegins) {
  for (const char* law : {"viscous_coulomb", "stiction", "dahl", "lugre"}) {
    Friction friction = SomeFriction(*FindLaw(law));
    friction.thermal = Thermal{-0.8, 40};
    friction.second_thermal = Thermal{-0.2, 9};
    JointTrajectory once = SomeTrajectory();
    const Prediction first = AlongMotion(friction).Predict(once);
    JointTrajectory twice = once;
    twice.time.resize(2 * kSamples);
    twice.velocity.resize(2 * kSamples);
    twice.time << once.time, once.time.array() + once.time[kSamples - 1];
    twice.velocity << once.velocity, once.velocity;
    twice.starts = {kSamples};
    const Prediction p = AlongMotion(friction).Predict(twice);
    // rounding of times of 700 s
    ExpectClose(p.force.head(kSamples), first.force, 1e-11);
    ExpectClose(p.force.tail(kSamples), first.force, 1e-11);
    EXPECT_EQ(p.energy[kSamples], 0) << law;
  }
}

TEST(AlongMotion, AddsWhatElseJoinsTheLevelToForceAndLossAlone) {
  Friction friction{"coulomb", {{"coulomb", 5}}, {}};
  JointTrajectory trajectory = EvenTrajectory(1, Eigen::Vector3d(0.5, -0.5, 0));
  trajectory.level = Eigen::Vector3d(1, 2, 3);
  const Prediction p = AlongMotion(friction).Predict(trajectory, {-1});
  EXPECT_EQ(p.force, Eigen::Vector3d(5, -6, 0));
  EXPECT_EQ(p.loss, Eigen::Vector3d(2.5, 3, 0));
  EXPECT_EQ(p.energy, Eigen::Vector3d::Constant(-1));
}

TEST(AlongMotion, ChangesTheSlopeWithTheHeat) {
  Friction friction = Warm(5, 15, -3, 600);
  friction.viscous_per_energy = 0.5;
  const JointTrajectory trajectory = EvenTrajectory(1, Eigen::Vector2d(0.5, -0.5));
  // slope 5 - 0.5 4 = 3, level 15 - 4
  EXPECT_NEAR(AlongMotion(friction).Predict(trajectory, {-4}).force[0], 1.5 + 11, 1e-14);
  friction.law = "lugre";
  friction.parameters = test::LuGreJoint().parameters;
  friction.parameters["static"] = 15;
  EXPECT_NEAR(AlongMotion(friction).Predict(trajectory, {-4}).force[0], 1.5 + 11, 1e-14);
}

TEST(AlongMotion, FindsTheFirstSampleWhereFrictionDrivesTheJoint) {
  // above 1 rad/s for minutes, then slow: E = -3 v F0 / (1 + 3 v) exceeds 15 + 5 * 0.05 in size
  Eigen::VectorXd velocity(4000);
  velocity << Eigen::VectorXd::Constant(3000, 2.0), Eigen::VectorXd::Constant(1000, 0.05);
  Friction friction = Warm(5, 15, -3, 600);
  EXPECT_EQ(AlongMotion(friction).Predict(EvenTrajectory(1, velocity)).first_driving, 3000);
  friction.law = "lugre";
  friction.parameters = test::LuGreJoint().parameters;
  friction.parameters["static"] = 15;
  EXPECT_EQ(AlongMotion(friction).Predict(EvenTrajectory(1, velocity)).first_driving, 3000);
}

TEST(AlongMotion, RemembersTheSideThatABrokenJointSlidesTo) {
  Friction friction = SomeFriction(*FindLaw("stiction"));
  EXPECT_EQ(AlongMotion(friction).Predict(EvenTrajectory(1, Eigen::Vector2d(0.5, -0.5))).end.slip,
            -1);
  EXPECT_EQ(AlongMotion(friction).Predict(EvenTrajectory(1, Eigen::Vector2d(0.5, 0))).end.slip, 0);
}

}  // namespace
}  // namespace warmjoint
