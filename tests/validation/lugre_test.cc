// The bristle of a joint in the engine, moved by a drive with a controller.
#include <gtest/gtest.h>
#include <warmjoint/prepared_log.h>
#include <warmjoint/recording.h>

#include "identification/answer/identify.h"
#include "identification/identifiers/identifier_list.h"
#include "sim/plant/plant.h"

namespace warmjoint {
namespace {

TEST(LuGreInTheEngine, ComesBackFromSlowAndSmallTurns) {
  Scenario scenario;
  scenario.name = "turns";
  scenario.plant = PlantKind::mujoco;
  scenario.robot = "rotary";
  scenario.joint = "hinge";
  scenario.friction.law = "lugre";
  scenario.friction.parameters = {{"viscous", 5},
                                  {"coulomb", 15},
                                  {"static", 20},
                                  {"stribeck_velocity", 0.05},
                                  {"bristle_stiffness", 2000},
                                  {"bristle_damping", 40}};
  scenario.motion.speed_list = {0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1};
  scenario.motion.travel = {{-0.04, 0.04}};
  scenario.motion.order = SegmentOrder::shuffled;
  scenario.noise.torque = 0.1;
  scenario.sampling = {250, 250, 0};
  scenario.timestep = 0.0005;
  scenario.duration = 60;
  scenario.seed = 3;
  const Measurements m = MakePlant(scenario)->Run(0).measurements;

  const Identifier& identifier = FindIdentifier("lugre");
  const Estimate estimate = IdentifyAndCheck(identifier, {Prepare(m), identifier.options, {}});
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  for (const auto& [name, truth] : scenario.friction.parameters) {
    const EstimatedParameter& found = *estimate.Find(name);
    EXPECT_NEAR(found.value, truth, 4 * *found.std) << name;
    EXPECT_LT(*found.std, 0.15 * truth) << name;
  }
}

}  // namespace
}  // namespace warmjoint
