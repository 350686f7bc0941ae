// Identify, attach, carry out the same motion again, identify again: the same friction.
#include <gtest/gtest.h>
#include <warmjoint/attach.h>
#include <warmjoint/prepared_log.h>

#include <cmath>

#include "identification/preparation/select.h"
#include "models/recording/read_recording.h"
#include "models/robots/robot_folder.h"
#include "sim/plant/plant.h"
#include "tests/support/judging.h"
#include "tests/support/shared_data.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

/// The engine's recording of `log`'s motion on `robot`, which gets the estimated friction.
Simulation Again(const Measurements& log, const Estimate& estimate, const std::string& robot,
                 const std::string& joint, const std::filesystem::path& folder, double noise) {
  const std::filesystem::path attached = folder / "attached.xml";
  AttachFriction(FindRobot(robot, "test"), {{joint, *estimate.friction}}, attached);

  Scenario scenario;
  scenario.name = "again";
  scenario.plant = PlantKind::mujoco;
  scenario.joint_kind = log.joint;
  scenario.robot = attached;
  scenario.joint = joint;
  scenario.friction = *estimate.friction;
  scenario.motion = MotionOf(log, SelectConstantSpeed(log));
  scenario.controller.bandwidth = 100;
  scenario.noise.torque = noise;
  scenario.sampling.rate = std::round(1 / (log.time[1] - log.time[0]));
  scenario.sampling.sensor_rate = scenario.sampling.rate;
  scenario.timestep = 0.001;
  scenario.duration = log.time[log.size() - 1] - log.time[0];
  scenario.seed = 99;
  return MakePlant(scenario)->Run(0);
}

void ExpectSameFriction(const Estimate& first, const Estimate& second) {
  ASSERT_EQ(second.status, Status::ok) << second.message;
  for (const EstimatedParameter& one : first.parameters) {
    const EstimatedParameter& other = *second.Find(one.name);
    // the intervals of both
    EXPECT_NEAR(other.value, one.value, 1.96 * std::hypot(*one.std, *other.std)) << one.name;
  }
}

TEST(RoundTrip, OfAJointThatWarmsUp) {
  Scenario scenario;
  scenario.name = "first";
  scenario.plant = PlantKind::mujoco;
  scenario.robot = "rotary";
  scenario.joint = "hinge";
  scenario.friction = {"asymmetric",
                       {{"viscous", 5}, {"coulomb_positive", 15}, {"coulomb_negative", 13}},
                       Thermal{-1.5, 240}};
  scenario.motion.speed_draws = Distribution{Distribution::Kind::uniform, 0.1, 1};
  scenario.motion.hold = 20;
  scenario.controller.bandwidth = 100;
  scenario.noise.torque = 0.2;
  scenario.sampling = {10, 10, 0};
  scenario.timestep = 0.002;
  scenario.duration = 1200;
  scenario.seed = 5;
  const Measurements log = MakePlant(scenario)->Run(0).measurements;

  const ScratchDirectory scratch;
  const std::map<std::string, std::string> law{{"law", "asymmetric"}};
  const Estimate first = test::Fitted("energy-ml", log, law);
  ASSERT_EQ(first.status, Status::ok) << first.message;
  const Simulation again = Again(log, first, "rotary", "hinge", scratch.path(), 0.2);
  ExpectSameFriction(first, test::Fitted("energy-ml", again.measurements, law));
}

TEST(RoundTrip, OfTheEmpsAxis) {
  WARMJOINT_NEED_SHARED("data/emps/DATA_EMPS.csv");
  ReadSettings layout;
  layout.map = {{"time", "t_s"}, {"position", "q_m"}, {"torque", "force_N"}};
  layout.joint = JointKind::linear;
  const Measurements log =
      Prepare(ReadRecordingFile(test::SharedFolder() / "data" / "emps" / "DATA_EMPS.csv", layout))
          .raw()
          .measurements;

  const ScratchDirectory scratch;
  const std::map<std::string, std::string> law{{"law", "asymmetric"}};
  const Estimate first = test::Fitted("nominal-ls", log, law);
  ASSERT_EQ(first.status, Status::ok) << first.message;
  const Simulation again = Again(log, first, "linear_axis", "carriage", scratch.path(), 1);
  ExpectSameFriction(first, test::Fitted("nominal-ls", again.measurements, law));
}

}  // namespace
}  // namespace warmjoint
