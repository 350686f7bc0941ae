// Friction that the engine carries out comes back: of robots of others, under gravity, of a bristle, and by attach.
#include <gtest/gtest.h>
#include <warmjoint/attach.h>
#include <warmjoint/prepared_log.h>
#include <warmjoint/recording.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "identification/preparation/select.h"
#include "models/foundation/atomic_file.h"
#include "models/robots/robot_folder.h"
#include "sim/model/load_model.h"
#include "sim/plant/plant.h"
#include "tests/support/bristle_recording.h"
#include "tests/support/emps_log.h"
#include "tests/support/judging.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

/// Twenty minutes of a joint in the engine, under a drive that is stiff enough to hold its speed.
Scenario InTheEngine(const std::string& robot, const std::string& joint, const Friction& friction) {
  Scenario scenario;
  scenario.name = "moved";
  scenario.plant = PlantKind::mujoco;
  scenario.robot = robot;
  scenario.joint = joint;
  scenario.friction = friction;
  scenario.controller.bandwidth = 100;
  scenario.noise.torque = 0.1;
  scenario.sampling = {10, 100, 4};
  scenario.timestep = 0.002;
  scenario.duration = 1200;
  scenario.seed = 3;
  return scenario;
}

Measurements LogOf(const Scenario& scenario) { return MakePlant(scenario)->Run(0).measurements; }

void ExpectSameFriction(const Estimate& first, const Estimate& second) {
  ASSERT_EQ(second.status, Status::ok) << second.message;
  for (const EstimatedParameter& one : first.parameters) {
    const EstimatedParameter& other = *second.Find(one.name);
    // the intervals of both
    EXPECT_NEAR(other.value, one.value, 1.96 * std::hypot(*one.std, *other.std)) << one.name;
  }
}

/// The engine's recording of `log`'s motion on `robot`, which gets the estimated friction.
Measurements Again(const Measurements& log, const Estimate& estimate, const std::string& robot,
                   const std::string& joint, double noise) {
  const ScratchDirectory scratch;
  const std::filesystem::path attached = scratch.path() / "attached.xml";
  AttachFriction(FindRobot(robot, "test"), {{joint, *estimate.friction}}, attached);

  Scenario scenario = InTheEngine(attached, joint, *estimate.friction);
  scenario.joint_kind = log.joint;
  scenario.motion = MotionOf(log, SelectConstantSpeed(log));
  scenario.noise.torque = noise;
  const double rate = std::round(1 / (log.time[1] - log.time[0]));
  scenario.sampling = {rate, rate, 0};
  scenario.timestep = 0.001;
  scenario.duration = log.time[log.size() - 1] - log.time[0];
  scenario.seed = 99;
  return LogOf(scenario);
}

const std::map<std::string, std::string> kTwoLevels{{"law", "asymmetric"}};

TEST(RoundTrip, OfAJointThatWarmsUp) {
  Scenario scenario =
      InTheEngine("rotary", "hinge",
                  {"asymmetric",
                   {{"viscous", 5}, {"coulomb_positive", 15}, {"coulomb_negative", 13}},
                   Thermal{-1.5, 240}});
  scenario.motion.speeds.draws = Distribution{Distribution::Kind::uniform, 0.1, 1};
  scenario.motion.hold = 20;
  scenario.noise.torque = 0.2;
  scenario.sampling = {10, 10, 0};
  scenario.seed = 5;
  const Measurements log = LogOf(scenario);
  const Estimate first = test::Fitted("energy-ml", log, kTwoLevels);
  ASSERT_EQ(first.status, Status::ok) << first.message;
  const Measurements again = Again(log, first, "rotary", "hinge", 0.2);
  ExpectSameFriction(first, test::Fitted("energy-ml", again, kTwoLevels));
}

TEST(RoundTrip, OfTheEmpsAxis) {
  WARMJOINT_NEED_SHARED(test::kEmpsFile);
  const Measurements log = Prepare(test::EmpsLog()).raw().measurements;
  const Estimate first = test::Fitted("nominal-ls", log, kTwoLevels);
  ASSERT_EQ(first.status, Status::ok) << first.message;
  const Measurements again = Again(log, first, "linear_axis", "carriage", 1);
  ExpectSameFriction(first, test::Fitted("nominal-ls", again, kTwoLevels));
}

struct RobotJointCase {
  std::string file;   // in shared/robots
  std::string joint;  // turns about a level axis in the reference pose, or carries most of the arm
};

void PrintTo(const RobotJointCase& robot, std::ostream* stream) { *stream << robot.file; }

class AnyonesRobot : public testing::TestWithParam<RobotJointCase> {};

/// Sweeps over a third of the joint's range, up to a rad to each side.
Scenario Sweeps(const std::filesystem::path& robot, const std::string& joint) {
  const LoadedModel loaded = LoadModel(robot);
  const mjModel* m = loaded.model.get();
  const mjtNum* range = m->jnt_range + 2 * mj_name2id(m, mjOBJ_JOINT, joint.c_str());
  const double middle = (range[0] + range[1]) / 2;
  const double reach = std::min(1.0, (range[1] - range[0]) / 3);

  Scenario scenario = InTheEngine(
      robot, joint, {"viscous_coulomb", {{"viscous", 2}, {"coulomb", 8}}, Thermal{-0.8, 240}});
  scenario.motion.speeds.draws = Distribution{Distribution::Kind::uniform, 0.1, 1};
  scenario.motion.travel.limits = {{middle - reach, middle + reach}};
  scenario.timestep = 0.001;
  return scenario;
}

TEST_P(AnyonesRobot, GivesBackTheFrictionOfAJointUnderGravity) {
  WARMJOINT_NEED_SHARED("robots/" + GetParam().file);
  const Scenario scenario =
      Sweeps(test::SharedFolder() / "robots" / GetParam().file, GetParam().joint);
  const Estimate estimate = test::Fitted("energy-ml", LogOf(scenario), {{"gravity", "sincos"}});
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  for (const auto& [name, truth] : test::TruthOf(scenario.friction)) {
    const EstimatedParameter& found = *estimate.Find(name);
    // the interval, and 1 %: reversals, between two samples, heat less than a constant speed
    const double reach = ((*found.interval95)[1] - (*found.interval95)[0]) / 2;
    EXPECT_NEAR(found.value, truth, reach + 0.01 * std::abs(truth)) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Shared, AnyonesRobot,
    testing::Values(RobotJointCase{"abb_irb140_drake/irb140_inertial_com_shifted.urdf", "joint2"},
                    RobotJointCase{"abb_yumi/yumi_nomesh.urdf", "yumi_joint_2_l"},
                    RobotJointCase{"franka_emika_panda/panda_nohand_nomesh.xml", "joint4"},
                    RobotJointCase{"kuka_iiwa_14/iiwa14_nomesh.xml", "joint2"},
                    RobotJointCase{"universal_robots_ur5e/ur5e_nomesh.xml", "elbow"}),
    [](const auto& robot) { return robot.param.file.substr(0, robot.param.file.find('/')); });

/// Sweeps of a pendulum over 5 rad.
Measurements Swings(const std::string& robot) {
  Scenario scenario = InTheEngine(
      robot, "hinge", {"viscous_coulomb", {{"viscous", 1}, {"coulomb", 6}}, Thermal{-0.6, 300}});
  scenario.motion.speeds.draws = Distribution{Distribution::Kind::uniform, 0.2, 2};
  scenario.motion.travel.limits = {{-2.5, 2.5}};
  scenario.seed = 7;
  return LogOf(scenario);
}

TEST(Gravity, OfAPendulumIsTakenOffBothWays) {
  const ScratchDirectory scratch;
  std::string model = ReadWholeFile(test::SourceFolder() / "models/robots/pendulum/pendulum.xml");
  const std::string option = "<option ";
  model.insert(model.find(option) + option.size(), "gravity=\"0 0 0\" ");
  WriteWholeFile(scratch.path() / "weightless.xml", model);
  const Measurements hanging = Swings("pendulum");
  const Estimate reference =
      test::Fitted("energy-ml", Swings(scratch.path() / "weightless.xml"), {{"gravity", "none"}});
  ASSERT_EQ(reference.status, Status::ok) << reference.message;
  EXPECT_NE(test::Fitted("energy-ml", hanging, {{"gravity", "none"}}).status, Status::ok);

  for (const char* gravity : {"sincos", "paired"}) {
    SCOPED_TRACE(gravity);
    const Estimate estimate = test::Fitted("energy-ml", hanging, {{"gravity", gravity}});
    ExpectSameFriction(reference, estimate);
    ASSERT_TRUE(estimate.gravity);
    // 1 kg at 0.5 m; what the speed still varies under gravity is 4.9 N.m / 100 rad/s slow
    const Eigen::VectorXd level = Eigen::VectorXd::Constant(1, std::acos(0.0));
    EXPECT_NEAR(estimate.gravity->Torque(level)[0], 4.905, 0.03);
  }
}

TEST(LuGreInTheEngine, ComesBackFromSlowAndSmallTurns) {
  Scenario scenario = InTheEngine("rotary", "hinge", test::LuGreJoint());
  scenario.motion.speeds.list = {0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1};
  scenario.motion.travel.limits = {{-0.04, 0.04}};
  scenario.motion.order = SegmentOrder::shuffled;
  scenario.controller = {};
  scenario.sampling = {250, 250, 0};
  scenario.timestep = 0.0005;
  scenario.duration = 60;
  const Estimate estimate = test::Answer("lugre", LogOf(scenario));
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  test::ExpectTold(estimate, scenario.friction.parameters, 4, 0.15);
}

}  // namespace
}  // namespace warmjoint
