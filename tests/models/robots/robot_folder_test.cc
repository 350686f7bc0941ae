#include "models/robots/robot_folder.h"

#include <gmock/gmock.h>

#include <cstdlib>

#include "models/foundation/bad_input.h"

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
  EXPECT_THAT([] { FindRobot("rotari", "my.yaml"); },
              ThrowsMessage<BadInput>(HasSubstr("my.yaml: there is no robot 'rotari'; did you mean "
                                                "'rotary'")));
  EXPECT_THAT([] { FindRobot("no/such.xml", "my.yaml"); },
              ThrowsMessage<BadInput>(HasSubstr("'no/such.xml' is neither a file nor")));
}

TEST(RobotFolder, RefusesADataFolderWithoutRobots) {
  setenv("WARMJOINT_DATA", "/nowhere", 1);
  EXPECT_THAT([] { DataFolder(); },
              ThrowsMessage<BadInput>(HasSubstr("was not found in /nowhere; set WARMJOINT_DATA")));
  unsetenv("WARMJOINT_DATA");
}

}  // namespace
}  // namespace warmjoint
