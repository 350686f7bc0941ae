// Gravity in the engine: a pendulum gives the friction that it gives without gravity.
#include <gtest/gtest.h>
#include <warmjoint/prepared_log.h>

#include <cmath>

#include "identification/answer/identify.h"
#include "identification/identifiers/identifier_list.h"
#include "models/foundation/atomic_file.h"
#include "models/recording/read_recording.h"
#include "scenarios/scenario.h"
#include "sim/plant/plant.h"
#include "tests/support/judging.h"
#include "tests/support/shared_data.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

/// The pendulum's model, and the same without gravity.
std::string Weightless(const std::filesystem::path& folder) {
  std::string model = ReadWholeFile(test::SourceFolder() / "models/robots/pendulum/pendulum.xml");
  const std::string option = "<option ";
  model.insert(model.find(option) + option.size(), "gravity=\"0 0 0\" ");
  WriteWholeFile(folder / "weightless.xml", model);
  return folder / "weightless.xml";
}

/// Twenty minutes of sweeps over 5 rad with a drive that is stiff enough to hold its speed.
Scenario Sweeps(const std::string& robot) {
  Scenario scenario;
  scenario.name = "sweeps";
  scenario.plant = PlantKind::mujoco;
  scenario.robot = robot;
  scenario.joint = "hinge";
  scenario.friction = {"viscous_coulomb", {{"viscous", 1}, {"coulomb", 6}}, Thermal{-0.6, 300}};
  scenario.motion.speed_draws = Distribution{Distribution::Kind::uniform, 0.2, 2};
  scenario.motion.travel = {{-2.5, 2.5}};
  scenario.controller.bandwidth = 100;
  scenario.noise.torque = 0.1;
  scenario.sampling = {10, 100, 4};
  scenario.timestep = 0.002;
  scenario.duration = 1200;
  scenario.seed = 7;
  return scenario;
}

Estimate Identify(const Measurements& measurements, const std::string& gravity) {
  return test::Fitted("energy-ml", measurements, {{"gravity", gravity}});
}

TEST(Gravity, OfAPendulumIsTakenOffBothWays) {
  const ScratchDirectory scratch;
  const Simulation hanging = MakePlant(Sweeps("pendulum"))->Run(0);
  const Simulation weightless = MakePlant(Sweeps(Weightless(scratch.path())))->Run(0);
  const Estimate reference = Identify(weightless.measurements, "none");
  ASSERT_EQ(reference.status, Status::ok) << reference.message;
  EXPECT_NE(Identify(hanging.measurements, "none").status, Status::ok);

  for (const char* gravity : {"sincos", "paired"}) {
    const Estimate estimate = Identify(hanging.measurements, gravity);
    ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
    for (const EstimatedParameter& one : reference.parameters) {
      const EstimatedParameter& other = *estimate.Find(one.name);
      // the intervals of both
      EXPECT_NEAR(other.value, one.value, 1.96 * std::hypot(*one.std, *other.std))
          << gravity << " " << one.name;
    }
    // 1 kg at 0.5 m; what the speed still varies under gravity is 4.9 N.m / 100 rad/s slow
    const Eigen::VectorXd level = Eigen::VectorXd::Constant(1, std::acos(0.0));
    EXPECT_NEAR(estimate.gravity->Torque(level)[0], 4.905, 0.03) << gravity;
  }
}

TEST(Gravity, OfTheEmpsAxisIsItsPublishedOffset) {
  WARMJOINT_NEED_SHARED("data/emps/DATA_EMPS.csv");
  ReadSettings layout;
  layout.map = {{"time", "t_s"}, {"position", "q_m"}, {"torque", "force_N"}};
  layout.joint = JointKind::linear;
  const Measurements log =
      ReadRecordingFile(test::SharedFolder() / "data" / "emps" / "DATA_EMPS.csv", layout);
  const Identifier& identifier = FindIdentifier("nominal-ls");
  const Options options = identifier.options.Read({{"gravity", "paired"}});
  const Estimate estimate = IdentifyUnchecked(identifier, {Prepare(log), options, {}});
  ASSERT_TRUE(estimate.Find("gravity_offset")) << estimate.message;

  // Janot, Gautier, Brunot 2019, from all samples: within our interval
  const auto [lower, upper] = *estimate.Find("gravity_offset")->interval95;
  EXPECT_LT(lower, -3.1648);
  EXPECT_GT(upper, -3.1648);
  EXPECT_LT(upper, 0);
}

}  // namespace
}  // namespace warmjoint
