#include "models/robots/read_urdf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/foundation/bad_input.h"
#include "tests/models/recording/temporary_file.h"

namespace warmjoint {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(ReadUrdf, GivesLinksAndJoints) {
  const TemporaryFile file("robot.urdf",
                           "<robot name='r'><link name='a'/><link name='b'/>"
                           "<joint name='j' type='continuous'><parent link='a'/>"
                           "<child link='b'/></joint></robot>");
  EXPECT_EQ(ReadUrdf(file.path())->getJoint("j")->child_link_name, "b");
}

TEST(ReadUrdf, NamesFileAndJointOfAJointWithoutLimits) {
  const TemporaryFile file("robot.urdf",
                           "<robot name='r'><link name='a'/><link name='b'/>"
                           "<joint name='elbow' type='revolute'><parent link='a'/>"
                           "<child link='b'/></joint></robot>");
  EXPECT_THAT([&] { ReadUrdf(file.path()); },
              ThrowsMessage<BadInput>(AllOf(HasSubstr(file.path()), HasSubstr("elbow"))));
}

TEST(ReadUrdf, RefusesWhatIsNoXml) {
  const TemporaryFile file("robot.urdf", "joints, links\n");
  EXPECT_THAT([&] { ReadUrdf(file.path()); },
              ThrowsMessage<BadInput>(HasSubstr("cannot be used as URDF")));
}

TEST(ReadUrdf, RefusesDepthThatWouldEndItsParser) {
  std::string deep = "<robot name='r'>\n";
  for (int i = 0; i < 200'000; ++i) deep += "<a>";
  const TemporaryFile file("robot.urdf", deep);
  EXPECT_THAT([&] { ReadUrdf(file.path()); },
              ThrowsMessage<BadInput>(HasSubstr(":2: nests deeper than 500 elements")));
}

}  // namespace
}  // namespace warmjoint
