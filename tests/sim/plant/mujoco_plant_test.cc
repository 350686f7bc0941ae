#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "models/friction/thermal.h"
#include "sim/plant/plant.h"
#include "sim/plant/single_joint_model.h"
#include "tests/support/refusal.h"
#include "tests/support/table1.h"

namespace warmjoint {
namespace {

/// Table I in the engine: 20 s holds at speeds from 0.1 to 1 rad/s, stored at 1 Hz; 200 s.
Scenario Table1() {
  Scenario scenario = test::Table1();
  scenario.name = "table1-mujoco";
  scenario.plant = PlantKind::mujoco;
  scenario.robot = "rotary";
  scenario.joint = "hinge";
  scenario.noise = {};
  scenario.controller.bandwidth = 100;
  scenario.timestep = 0.002;
  scenario.duration = 200;
  return scenario;
}

Simulation Record(const Scenario& scenario, std::uint64_t realization = 0) {
  return MakeMujocoPlant(scenario)->Run(realization);
}

TEST(MujocoPlant, DrivesWithTheTorqueOfFrictionAndRecordsItsLossAndEnergy) {
  const Simulation r = Record(Table1());
  ASSERT_EQ(r.measurements.size(), 200);
  const DiscreteThermal step = Discretise({-3, 600}, 1);
  double energy = 0;
  for (Eigen::Index i = 0; i < 200; ++i) {
    ASSERT_EQ(r.measurements.time[i], static_cast<double>(i));
    // settled for ten time constants of the drive when a segment begins, for 100 afterwards
    const double tolerance = i % 20 == 0 ? 0.05 : 1e-3;
    EXPECT_NEAR(r.measurements.torque[i], r.truth.force[i], tolerance) << "sample " << i;
    const double v = r.truth.velocity[i];
    EXPECT_GE(std::abs(v), 0.0999);
    EXPECT_NEAR(r.truth.force[i], WarmForce(v, 5 * v + 15 * Sign(v), r.truth.energy[i]), 1e-12);
    EXPECT_DOUBLE_EQ(r.truth.loss[i], Loss(v, r.truth.force[i]));

    // (22) with the loss held from sample to sample; a reversal of 0.14 s costs at most 0.14 W s
    // of each second in which it happens: k W / tau * 0.14 s, ten times, and the hold's own h^2
    EXPECT_NEAR(r.truth.energy[i], energy, 10 * 0.14 * 3 * 20 / 600.0);
    energy = ThermalStep(step.gain, step.pole, energy, r.truth.loss[i]);
  }
  EXPECT_LT(energy, -2);
}

TEST(MujocoPlant, KnowsWhatWeightAndInertiaAreOfTheTorque) {
  Scenario scenario = Table1();
  scenario.robot = "pendulum";
  scenario.motion.hold = 0;
  scenario.motion.travel.limits = {0.5, 2.5};
  scenario.sampling = {.rate = 10, .sensor_rate = 50};
  const Simulation r = Record(scenario);
  ASSERT_EQ(r.rigid.size(), r.measurements.size());
  EXPECT_LT((r.measurements.torque - r.rigid - r.truth.force).cwiseAbs().maxCoeff(), 1e-9);
  // 4.9 N.m when level, where the speed is steady
  EXPECT_GT(r.rigid.maxCoeff(), 4.5);
}

TEST(MujocoPlant, RepeatsItselfBitForBit) {
  Scenario scenario = Table1();
  scenario.duration = 30;
  scenario.noise = {0.5, 0.01, 0.001};
  const auto plant = MakeMujocoPlant(scenario);
  const Simulation first = plant->Run(3);
  plant->Run(4);
  const Simulation again = plant->Run(3);
  const Simulation other = Record(scenario, 3);
  EXPECT_EQ(first.measurements.torque, again.measurements.torque);
  EXPECT_EQ(first.measurements.torque, other.measurements.torque);
  EXPECT_EQ(first.measurements.position, other.measurements.position);
  EXPECT_NE(first.measurements.torque, plant->Run(4).measurements.torque);
}

TEST(MujocoPlant, AddsNoiseToTheLogAndNotToTheTruth) {
  Scenario scenario = Table1();
  const Simulation clean = Record(scenario);
  scenario.noise.torque = 0.5;
  const Simulation noisy = Record(scenario);
  EXPECT_EQ(noisy.truth.force, clean.truth.force);
  const Eigen::VectorXd noise = noisy.measurements.torque - clean.measurements.torque;
  // the mean square of 200 samples has a standard deviation of 10 %: five of them
  EXPECT_NEAR(noise.squaredNorm() / 200, 0.25, 0.25 * 0.5);
  EXPECT_EQ(noisy.truth.torque_noise, 0.5);
}

TEST(MujocoPlant, StandsStillInRests) {
  Scenario scenario = Table1();
  scenario.motion.rests = Rests{20, 20};
  scenario.duration = 60;
  const Simulation r = Record(scenario);
  for (Eigen::Index i = 22; i < 38; ++i) {
    EXPECT_LT(std::abs(r.truth.velocity[i]), 1e-9);
    EXPECT_LT(r.truth.loss[i], 1e-9);
  }
  EXPECT_GT(r.truth.energy[38], r.truth.energy[22]) << "the joint cools";
}

/// A light elbow under gravity, 0.05 kg.m^2 and 1.96 N.m, that travels between its limits at three speeds.
Scenario LightElbow(double coulomb) {
  Scenario scenario;
  scenario.name = "light-elbow";
  scenario.plant = PlantKind::mujoco;
  scenario.robot = testing::TempDir() + "/light_elbow.xml";
  WriteWholeFile(scenario.robot, R"(<mujoco><compiler angle="radian"/><worldbody><body>
    <joint name="elbow" axis="0 1 0" limited="true" range="-2 2"/>
    <inertial pos="0 0 -0.2" mass="1" diaginertia="0.01 0.01 0.01"/></body></worldbody></mujoco>)");
  scenario.joint = "elbow";
  scenario.friction = {"coulomb", {{"coulomb", coulomb}}, std::nullopt};
  scenario.motion.speeds.list = {0.2, 0.5, 1};
  scenario.motion.travel.joint_limits = true;
  scenario.timestep = 0.001;
  scenario.duration = 100;
  return scenario;
}

TEST(MujocoPlant, NoticesAJointThatDoesNotFollowAndNamesTheDriveThatCuresIt) {
  Scenario slow_drive = Table1();
  slow_drive.controller.bandwidth = 5;
  slow_drive.motion.speeds.draws = Distribution{Distribution::Kind::fixed, 0.1};
  Scenario elbow = LightElbow(4), stiff_elbow = LightElbow(8);
  elbow.controller.bandwidth = stiff_elbow.controller.bandwidth = 20;
  for (Scenario scenario : {slow_drive, elbow, stiff_elbow}) {
    const Following astray = Record(scenario).following;
    EXPECT_FALSE(astray.Follows()) << scenario.name << ": " << astray.share;
    EXPECT_EQ(astray.bandwidth, scenario.controller.bandwidth);

    scenario.controller.bandwidth = astray.sufficient;
    if (astray.timestep != 0) scenario.timestep = astray.timestep;
    const Following cured = Record(scenario).following;
    EXPECT_GE(cured.share, 0.9) << scenario.name;
  }
  EXPECT_NE(Record(stiff_elbow).following.timestep, 0) << "its drive is too fast for 1 ms";
}

TEST(MujocoPlant, ChoosesADriveForInertiaFrictionGravityAndMotion) {
  // (2 * 4 / 0.2) / 0.05 / 5.4 = 148 rad/s, in two digits
  const Following elbow = Record(LightElbow(4)).following;
  EXPECT_DOUBLE_EQ(elbow.bandwidth, 150);
  EXPECT_GE(elbow.share, 0.9);
  // 10 sqrt(1.962 / 0.05) = 62.6 rad/s
  EXPECT_DOUBLE_EQ(Record(LightElbow(0.1)).following.bandwidth, 63);
  // without need, and where the step allows no more
  Scenario easy = Table1();
  easy.controller.bandwidth = 0;
  easy.friction = {"coulomb", {{"coulomb", 1}}, std::nullopt};
  EXPECT_DOUBLE_EQ(Record(easy).following.bandwidth, 20);
  EXPECT_DOUBLE_EQ(Record(LightElbow(8)).following.bandwidth, 0.2 / 0.001);
}

TEST(MujocoPlant, FollowsTableOneAndRests) {
  Scenario scenario = Table1();
  scenario.motion.rests = Rests{40, 20};
  EXPECT_GE(Record(scenario).following.share, 0.95);
  scenario.motion = {};
  scenario.motion.corners = {{0, 0}, {200, 0}};
  EXPECT_EQ(Record(scenario).following.share, 1) << "no speed is asked for";
}

TEST(MujocoPlant, RefusesWhatCannotBeByScenarioAndKey) {
  const std::string broken = testing::TempDir() + "/broken_robot.xml";
  WriteWholeFile(broken, "<mujoco><worldbody><bod/></worldbody></mujoco>");
  const struct {
    std::function<void(Scenario&)> edit;
    std::vector<std::string> names;
  } cases[] = {
      {[](Scenario& s) { s.joint = "hing"; }, {"table1-mujoco", "'hing'", "did you mean 'hinge'"}},
      {[](Scenario& s) { s.robot = "rotory"; }, {"table1-mujoco", "'rotory'", "did you mean"}},
      {[&](Scenario& s) { s.robot = broken; }, {broken}},
      {[](Scenario& s) { s.sampling.rate = 30; }, {"table1-mujoco", "sampling.rate", "0.002"}},
      {[](Scenario& s) { s.controller.bandwidth = 1000; },
       {"table1-mujoco", "controller.bandwidth is 1000", "at most 100"}},
      {[](Scenario& s) { s.friction.parameters.clear(); }, {"table1-mujoco", "parameter viscous"}},
      {[](Scenario& s) { s.friction.parameters["viscous"] = 5000; },
       {"table1-mujoco", "hinge_friction", "armature of"}},
      {[](Scenario& s) {
         s.motion.speeds.draws = Distribution{Distribution::Kind::fixed, 1};
         s.motion.hold = s.duration = 2000;
       },
       {"table1-mujoco", "'hinge'", "limits"}},
  };
  for (const auto& [edit, names] : cases) {
    Scenario scenario = Table1();
    edit(scenario);
    test::ExpectNamed(test::RefusalOf([&] { Record(scenario); }), names);
  }
}

/// A motion that reaches `farthest`, rad: any room up to there is too small, and any beyond it does.
template <typename Motion>
void ExpectFarthest(const Motion& motion, double duration, double start, double farthest) {
  Scenario scenario;
  scenario.name = "reach";
  scenario.joint = "hinge";
  scenario.duration = duration;
  const auto check = [&](double limit) { CheckReach({scenario, {-10, limit}}, motion, start); };
  EXPECT_NO_THROW(check(farthest));
  EXPECT_NO_THROW(check(farthest + 1e-3));
  test::ExpectNamed(test::RefusalOf([&] { check(farthest - 1e-3); }), {"reach: ", "'hinge'"});
}

using Pieces = std::vector<MotionSegment>;
using Corners = std::vector<VelocityCorner>;

TEST(MotionReach, PiecesAddUp) {
  ExpectFarthest(Pieces{{2, 0.5}, {1, -1}, {1, 0.25}}, 4, 0.5, 1.5);
  ExpectFarthest(Pieces{{1, -0.5}, {3, 0.5}}, 4, 0, 1);
}

TEST(MotionReach, ARampThatReversesIsFarthestWhereItTurns) {
  // from 1 rad/s to -3 rad/s in 4 s: it turns after 1 s, half a radian ahead
  ExpectFarthest(Corners{{0, 1}, {4, -3}, {5, -3}}, 5, 0, 0.5);
  // and one that only slows down, at its end
  ExpectFarthest(Corners{{0, 1}, {2, 0}, {4, 0}}, 4, 0.25, 1.25);
}

TEST(MotionReach, OnlyTheWayUntilTheEndCounts) {
  // a hold that would go on
  ExpectFarthest(Corners{{0, 0.5}, {10, 0.5}}, 3, 0, 1.5);
  // a ramp that would go on: 0.25 t^2 of it
  ExpectFarthest(Corners{{0, 0}, {4, 2}}, 2, 0, 1);
  // a speed that stays behind the last corner
  ExpectFarthest(Corners{{0, 0}, {2, 1}}, 5, 0, 4);
}

}  // namespace
}  // namespace warmjoint
