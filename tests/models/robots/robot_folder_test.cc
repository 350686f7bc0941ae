#include "models/robots/robot_folder.h"

#include <gmock/gmock.h>

#include <cstdlib>

#include "models/foundation/bad_input.h"
#include "tests/support/refusal.h"

namespace warmjoint {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(RobotFolder, ListsAndFindsTheRobotsOfTheProject) {
  EXPECT_THAT(RobotNames(), Contains("rotary"));
  for (const std::string& name : RobotNames()) {
    EXPECT_TRUE(std::filesystem::is_regular_file(FindRobot(name, "test"))) << name;
  }
}

TEST(RobotFolder, TakesAPathAsItIs) {
  const std::filesystem::path file = FindRobot("rotary", "test");
  EXPECT_EQ(FindRobot(file.string(), "test"), file);
}

TEST(RobotFolder, RefusesWhatIsNoRobot) {
  test::ExpectRefused(
      {{"rotari", "my.yaml: ", "'rotary'"}, {"no/such.xml", "my.yaml: ", "no/such.xml"}},
      [](const std::string& name) { FindRobot(name, "my.yaml"); });
}

TEST(RobotFolder, RefusesADataFolderWithoutRobots) {
  setenv("WARMJOINT_DATA", "/nowhere", 1);
  EXPECT_THAT([] { DataFolder(); },
              ThrowsMessage<BadInput>(HasSubstr("was not found in /nowhere; set WARMJOINT_DATA")));
  unsetenv("WARMJOINT_DATA");
}

}  // namespace
}  // namespace warmjoint
