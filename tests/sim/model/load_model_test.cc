#include "sim/model/load_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/models/recording/temporary_file.h"

namespace warmjoint {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

/// A URDF arm of one moving link; `inertial` and `geometry` are put into that link.
std::string Arm(const std::string& inertial, const std::string& geometry = "") {
  return R"(<robot name="arm">
  <link name="base"/>
  <joint name="hinge" type="revolute">
    <parent link="base"/><child link="arm"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="5" velocity="2"/>
  </joint>
  <link name="arm">)" +
         inertial + geometry + R"(</link>
  <joint name="tip_joint" type="fixed"><parent link="arm"/><child link="tip"/></joint>
  <link name="tip"/>
</robot>
)";
}

constexpr char kInertial[] =
    R"(<inertial><mass value="2"/>
    <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>)";

TEST(LoadModel, ReadsUrdfWithItsMassesAndLimits) {
  const TemporaryFile file("arm.urdf", Arm(kInertial));
  const LoadedModel loaded = LoadModel(file.path());
  EXPECT_THAT(loaded.notices, IsEmpty());
  const int joint = mj_name2id(loaded.model.get(), mjOBJ_JOINT, "hinge");
  ASSERT_GE(joint, 0);
  EXPECT_EQ(loaded.model->body_mass[loaded.model->jnt_bodyid[joint]], 2);
  EXPECT_EQ(loaded.model->jnt_range[2 * joint + 1], 1);
}

TEST(LoadModel, LeavesOutPackageMeshesWithOneNotice) {
  const std::string geometry =
      R"(<collision><geometry><mesh filename="package://arm/meshes/a.stl"/></geometry></collision>
      <collision><geometry><mesh filename="package://arm/meshes/b.stl"/></geometry></collision>
      <collision><geometry><sphere radius="0.1"/></geometry></collision>)";
  const TemporaryFile file("arm.urdf", Arm(kInertial, geometry));
  const LoadedModel loaded = LoadModel(file.path());
  EXPECT_THAT(loaded.notices, ElementsAre(AllOf(HasSubstr("2 meshes"), HasSubstr("package://"),
                                                HasSubstr("a.stl, b.stl"))));
  EXPECT_EQ(loaded.model->nmesh, 0);
  EXPECT_EQ(loaded.model->ngeom, 1);
}

TEST(LoadModel, RefusesMovingLinkWithoutMassByItsName) {
  const TemporaryFile file("arm.urdf", Arm(""));
  EXPECT_THAT([&] { LoadModel(file.path()); },
              ThrowsMessage<BadInput>(
                  AllOf(HasSubstr(file.path()), HasSubstr("link 'arm'"), HasSubstr("<inertial>"))));
}

TEST(LoadModel, DoesNotTakeTheMassOfALinkFromItsShape) {
  // MuJoCo would fill the sphere with water
  const TemporaryFile file(
      "arm.urdf", Arm("", R"(<collision><geometry><sphere radius="0.1"/></geometry></collision>)"));
  EXPECT_THAT([&] { LoadModel(file.path()); },
              ThrowsMessage<BadInput>(HasSubstr("link 'arm' moves")));
}

TEST(LoadModel, NamesFileAndLineOfAnUnclosedElement) {
  const TemporaryFile file("broken.xml",
                           "<mujoco>\n<worldbody>\n<body>\n</worldbody>\n</mujoco>\n");
  EXPECT_THAT([&] { LoadModel(file.path()); },
              ThrowsMessage<BadInput>(HasSubstr(file.path() + ":3: MuJoCo cannot read it")));
}

TEST(LoadModel, NamesFileAndLineOfUnknownElement) {
  const TemporaryFile file("unknown.xml",
                           "<mujoco>\n<worldbody>\n<bodi/>\n</worldbody>\n</mujoco>\n");
  EXPECT_THAT([&] { LoadModel(file.path()); },
              ThrowsMessage<BadInput>(AllOf(HasSubstr(file.path() + ":3"), HasSubstr("bodi"))));
}

TEST(LoadModel, RefusesWhatCannotBeCompiled) {
  const TemporaryFile file("massless.xml",
                           "<mujoco><worldbody><body name='b'><joint/></body></worldbody>"
                           "</mujoco>");
  EXPECT_THAT([&] { LoadModel(file.path()); },
              ThrowsMessage<BadInput>(AllOf(HasSubstr(file.path()), HasSubstr("'b'"))));
}

TEST(LoadModel, PassesOnWhatThePluginRefuses) {
  const TemporaryFile file("friction.xml", R"(<mujoco>
  <extension><plugin plugin="warmjoint.friction"/></extension>
  <worldbody><body><joint name="j"/><geom size="0.1"/></body></worldbody>
  <actuator>
    <plugin name="f" joint="j" plugin="warmjoint.friction" actdim="2">
      <config key="law" value="coulomb"/><config key="coulomb" value="-1"/>
    </plugin>
  </actuator>
</mujoco>)");
  EXPECT_THAT([&] { LoadModel(file.path()); },
              ThrowsMessage<BadInput>(AllOf(HasSubstr(file.path()), HasSubstr("actuator 'f'"),
                                            HasSubstr("coulomb is -1"))));
}

TEST(LoadModel, RefusesAFileThatIsAbsentOrEmpty) {
  EXPECT_THAT([] { LoadModel("no/such/robot.xml"); },
              ThrowsMessage<BadInput>(HasSubstr("no/such/robot.xml")));
  const TemporaryFile file("empty.xml", " ");
  EXPECT_THAT([&] { LoadModel(file.path()); }, ThrowsMessage<BadInput>(HasSubstr(file.path())));
}

TEST(LoadModel, RefusesWhatCannotBeBuilt) {
  std::string deep;
  for (int i = 0; i < 100'000; ++i) deep += "<body>";
  const TemporaryFile nested("deep.xml", "<mujoco><worldbody>" + deep);
  EXPECT_THROW(LoadModel(nested.path()), BadInput);
  const TemporaryFile itself("itself.xml", "<mujoco><include file='itself.xml'/></mujoco>");
  EXPECT_THROW(LoadModel(itself.path()), BadInput);
  const TemporaryFile texture(
      "texture.xml",
      "<mujoco><asset><texture name='t' type='2d' builtin='flat' width='40000' "
      "height='40000'/></asset></mujoco>");
  EXPECT_THAT([&] { LoadModel(texture.path()); },
              ThrowsMessage<BadInput>(HasSubstr("make 4.5 GiB")));
}

}  // namespace
}  // namespace warmjoint
