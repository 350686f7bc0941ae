// Robots of others: friction on one joint of each, a motion at constant speeds, and back.
#include <gtest/gtest.h>
#include <warmjoint/prepared_log.h>
#include <warmjoint/recording.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "identification/answer/identify.h"
#include "identification/identifiers/identifier_list.h"
#include "sim/model/load_model.h"
#include "sim/plant/plant.h"
#include "tests/support/shared_data.h"

namespace warmjoint {
namespace {

struct RobotJointCase {
  std::string file;   // in shared/robots
  std::string joint;  // turns about a level axis in the reference pose, or carries most of the arm
};
void PrintTo(const RobotJointCase& robot, std::ostream* stream) { *stream << robot.file; }

class AnyonesRobot : public testing::TestWithParam<RobotJointCase> {};

/// Twenty minutes over a third of the joint's range, up to a rad to each side.
Scenario Sweeps(const std::filesystem::path& robot, const std::string& joint) {
  const LoadedModel loaded = LoadModel(robot);
  const mjModel* m = loaded.model.get();
  const int id = mj_name2id(m, mjOBJ_JOINT, joint.c_str());
  const mjtNum* range = m->jnt_range + 2 * id;
  const double middle = (range[0] + range[1]) / 2;
  const double reach = std::min(1.0, (range[1] - range[0]) / 3);

  Scenario scenario;
  scenario.name = robot.filename();
  scenario.plant = PlantKind::mujoco;
  scenario.robot = robot;
  scenario.joint = joint;
  scenario.friction = {"viscous_coulomb", {{"viscous", 2}, {"coulomb", 8}}, Thermal{-0.8, 240}};
  scenario.motion.speed_draws = Distribution{Distribution::Kind::uniform, 0.1, 1};
  scenario.motion.travel = {{middle - reach, middle + reach}};
  scenario.controller.bandwidth = 100;
  scenario.noise.torque = 0.1;
  scenario.sampling = {10, 100, 4};
  scenario.timestep = 0.001;
  scenario.duration = 1200;
  scenario.seed = 3;
  return scenario;
}

TEST_P(AnyonesRobot, GivesBackTheFrictionOfAJointUnderGravity) {
  WARMJOINT_NEED_SHARED("robots/" + GetParam().file);
  const Scenario scenario =
      Sweeps(test::SharedFolder() / "robots" / GetParam().file, GetParam().joint);
  const Simulation recording = MakePlant(scenario)->Run(0);

  const Identifier& identifier = FindIdentifier("energy-ml");
  const Estimate estimate = IdentifyUnchecked(
      identifier,
      {Prepare(recording.measurements), identifier.options.Read({{"gravity", "sincos"}}), {}});
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  for (const auto& [name, truth] : {std::pair{"viscous", 2.0},
                                    {"coulomb", 8.0},
                                    {"thermal_gain", -0.8},
                                    {"thermal_time_constant", 240.0}}) {
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

}  // namespace
}  // namespace warmjoint
