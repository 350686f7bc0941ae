#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/foundation/atomic_file.h"
#include "scenarios/read_scenario.h"
#include "tests/tools/cli/recording_file.h"
#include "tests/tools/cli/run_program.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

TEST(RepeatMotion, CarriesARecordingOutAgain) {
  const ScratchDirectory scratch;
  const std::string log = scratch.path() / "log.csv", scenario = scratch.path() / "again.yaml";
  WriteRecordingFile(log, 480,
                     [](int i) { return (i / 30 % 2 ? -1 : 1) * 0.2 * (1 + i / 60 % 4); });
  WriteWholeFile(scenario,
                 "plant: mujoco\nrobot: rotary\njoint: hinge\n"
                 "friction: {law: viscous_coulomb, parameters: {viscous: 5, coulomb: 15}}\n"
                 "sampling: {rate: 10, sensor_rate: 100}\n");
  const std::string folder = scratch.path() / "again";
  const ProgramAnswer answer = RunWarmjoint({"simulate", scenario, "--motion", log, "-o", folder});
  ASSERT_EQ(answer.status, 0) << answer.err;

  // what was done can be done again without the recording
  const Scenario written = ReadScenario(folder + "/scenario.yaml");
  EXPECT_GT(written.motion.corners.size(), 30u);
  EXPECT_EQ(written.duration, 479);
}

TEST(RepeatMotion, RefusesARunBesideIt) {
  const ProgramAnswer answer =
      RunWarmjoint({"simulate", "--from", "R", "--motion", "L", "-o", "D"});
  EXPECT_EQ(answer.status, 2);
}

}  // namespace
}  // namespace warmjoint
