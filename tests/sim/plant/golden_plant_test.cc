// The ideal plant against recordings that the project did not make.
#include <gtest/gtest.h>

#include "sim/plant/plant.h"
#include "tests/support/golden.h"
#include "tests/support/table1.h"

namespace warmjoint {
namespace {

TEST(GoldenPlant, LogsTheRecordingOfEveryLawThatSlidesSteadily) {
  for (const char* name : {"coulomb", "viscous_coulomb", "asymmetric", "stiction", "stribeck",
                           "asymmetric_stribeck"}) {
    const test::GoldenMotion golden = test::ReadGoldenMotion(name);
    const nlohmann::json plan = test::ReadGolden(name);
    Scenario scenario = test::Table1();
    scenario.friction = golden.friction;
    scenario.motion.speed_draws.reset();
    scenario.motion.speed_list = plan.at("speeds").get<std::vector<double>>();
    scenario.motion.hold = plan.at("hold");
    scenario.noise.torque = 0;
    scenario.sampling.rate = 1 / golden.course.step;
    scenario.duration = golden.course.step * static_cast<double>(golden.force.size());
    const Simulation recording = MakePlant(scenario)->Run(0);
    EXPECT_EQ(recording.measurements.velocity, golden.course.velocity) << name;
    // the same equations: rounding of 600 steps at 20 N.m
    EXPECT_LT((recording.measurements.torque - golden.force).cwiseAbs().maxCoeff(), 2e-12) << name;
    EXPECT_LT((recording.truth.energy - golden.energy).cwiseAbs().maxCoeff(), 2e-12) << name;
  }
}

}  // namespace
}  // namespace warmjoint
