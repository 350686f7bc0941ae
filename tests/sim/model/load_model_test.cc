#include "sim/model/load_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/attach.h>

#include "models/foundation/atomic_file.h"
#include "tests/models/recording/temporary_file.h"
#include "tests/sim/model/light_friction.h"
#include "tests/support/refusal.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

namespace fs = std::filesystem;

/// A URDF arm of one moving link; `inertial` and `geometry` are put into that link.
std::string Arm(const std::string& inertial, const std::string& geometry = "",
                const std::string& extension = "") {
  return R"(<robot name="arm">
  <link name="base"/>
  <joint name="hinge" type="revolute">
    <parent link="base"/><child link="arm"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="5" velocity="2"/>
  </joint>
  <link name="arm">)" +
         inertial + geometry + R"(</link>
  <joint name="tip_joint" type="fixed"><parent link="arm"/><child link="tip"/></joint>
  <link name="tip"/>)" +
         extension + "</robot>\n";
}

/// A hinge that another plugin's actuator drives.
std::string DrivenBy(const std::string& plugin) {
  return R"(<mujoco><extension><plugin plugin=")" + plugin +
         R"("><instance name="p"><config key="kp" value="40"/></instance></plugin></extension>
    <worldbody><body><joint name="j" axis="0 1 0"/><geom size="0.1"/></body></worldbody>
    <actuator><plugin joint="j" plugin=")" +
         plugin + R"(" instance="p"/></actuator></mujoco>)";
}

constexpr char kInertial[] =
    R"(<inertial><mass value="2"/>
    <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>)";

TEST(LoadModel, ReadsUrdfWithItsMassesAndLimits) {
  const TemporaryFile file("arm.urdf", Arm(kInertial));
  const LoadedModel loaded = LoadModel(file.path());
  EXPECT_TRUE(loaded.notices.empty());
  const int joint = mj_name2id(loaded.model.get(), mjOBJ_JOINT, "hinge");
  ASSERT_GE(joint, 0);
  EXPECT_EQ(loaded.model->body_mass[loaded.model->jnt_bodyid[joint]], 2);
  EXPECT_EQ(loaded.model->jnt_range[2 * joint + 1], 1);
}

TEST(LoadModel, RefusesWhatItCannotBuildByFileAndElement) {
  const struct {
    std::string text;
    std::vector<std::string> names;
  } cases[] = {
      // a link without mass, which MuJoCo would fill with water where it has a shape
      {Arm(""), {": link 'arm'", "<inertial>"}},
      {Arm("", "<collision><geometry><sphere radius='0.1'/></geometry></collision>"), {"'arm'"}},
      // an element that is not closed, and one that is not known
      {"<mujoco>\n<worldbody>\n<body>\n</worldbody>\n</mujoco>\n", {":3: "}},
      {"<mujoco>\n<worldbody>\n<bodi/>\n</worldbody>\n</mujoco>\n", {":3: ", "bodi"}},
      {"<mujoco><worldbody><body name='b'><joint/></body></worldbody></mujoco>", {"'b'"}},
      {" ", {}},
      {"<mujoco><include file='model.xml'/></mujoco>", {}},
      {"<mujoco><asset><texture name='t' type='2d' builtin='flat' width='40000' height='40000'/>"
       "</asset></mujoco>",
       {"<texture>", "4.5 GiB"}},
      {DrivenBy("acme.drive"), {"'acme.drive'"}},
      // what our plugin refuses
      {R"(<mujoco><extension><plugin plugin="warmjoint.friction"/></extension>
  <worldbody><body><joint name="j"/><geom size="0.1"/></body></worldbody><actuator>
    <plugin name="f" joint="j" plugin="warmjoint.friction" actdim="2">
      <config key="law" value="coulomb"/><config key="coulomb" value="-1"/>
    </plugin></actuator></mujoco>)",
       {"actuator 'f'", "coulomb is '-1'"}},
  };
  for (const auto& [text, names] : cases) {
    const TemporaryFile file("model.xml", text);
    const std::string refusal = test::RefusalOf([&] { LoadModel(file.path()); });
    test::ExpectNamed(refusal, names);
    test::ExpectNamed(refusal, {file.path()});
  }
  test::ExpectNamed(test::RefusalOf([] { LoadModel("no/such/robot.xml"); }), {"no/such/robot.xml"});
  std::string deep;
  for (int i = 0; i < 100'000; ++i) deep += "<body>";
  const TemporaryFile nested("deep.xml", "<mujoco><worldbody>" + deep);
  EXPECT_THROW(LoadModel(nested.path()), BadInput);
}

TEST(OtherPlugins, ThatComeWithMujocoAreLoadedWhereAModelAsksForThem) {
  const TemporaryFile model("pid.xml", DrivenBy("mujoco.pid"));
  const ScratchDirectory folder;
  const auto out = folder.path() / "out.xml";
  AttachFriction(model.path(), {{"j", test::LightFriction()}}, out);
  const LoadedModel loaded = LoadModel(out);
  EXPECT_EQ(loaded.model->nplugin, 2);
  EXPECT_EQ(loaded.model->nactuator, 2);

  // the controller works beside the friction: 40 N.m/rad on a step of 1 rad
  const DataPtr data(mj_makeData(loaded.model.get()));
  data->ctrl[0] = 1;
  mj_forward(loaded.model.get(), data.get());
  EXPECT_DOUBLE_EQ(data->actuator_force[0], 40);
}

constexpr char kModel[] = R"(<mujoco>
  <compiler angle="degree" eulerseq="zyx"/>
  <option timestep="0.0012345678901234"/>
  <default><default class="thin"><geom size="0.0123456789012345"/></default></default>
  <worldbody>
    <frame pos="0.1 0.2 0.3">
      <body euler="10.123456789 20 30" pos="0.333333333333333333 1e-7 0">
        <joint name="j" range="-33.3333333333 77"/>
        <geom class="thin" type="capsule" fromto="0 0 0 0.1 0.2 0.3" mass="1.2345678901234567"/>
      </body>
    </frame>
  </worldbody>
  <actuator><position joint="j" kp="12.3456789012345"/></actuator>
  <keyframe><key qpos="0.12345678901234567"/></keyframe>
</mujoco>)";

SpecPtr Parse(const std::string& text) {
  char error[300] = "";
  SpecPtr spec(mj_parseXMLString(text.c_str(), nullptr, error, sizeof(error)));
  EXPECT_TRUE(spec) << error;
  return spec;
}

TEST(ModelToXml, KeepsEveryBit) {
  const SpecPtr spec = Parse(kModel);
  const ModelPtr a(mj_compile(spec.get(), nullptr));
  const SpecPtr again = Parse(ModelToXml(*spec, {}));
  const ModelPtr b(mj_compile(again.get(), nullptr));
  EXPECT_EQ(a->opt.timestep, b->opt.timestep);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(a->body_pos[3 + i], b->body_pos[3 + i]);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(a->body_iquat[4 + i], b->body_iquat[4 + i]);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(a->body_inertia[3 + i], b->body_inertia[3 + i]);
  EXPECT_EQ(a->body_mass[1], b->body_mass[1]);
  EXPECT_EQ(a->jnt_range[0], b->jnt_range[0]);
  EXPECT_EQ(a->actuator_gainprm[0], b->actuator_gainprm[0]);
  EXPECT_EQ(a->key_qpos[0], b->key_qpos[0]);
  EXPECT_EQ(a->geom_size[1], b->geom_size[1]);
}

TEST(ModelToXml, KeepsTheNotationOfTheModel) {
  const std::string text = ModelToXml(*Parse(kModel), {});
  test::ExpectNamed(text, {"euler=", "fromto=", "<position", "class=\"thin\"", "<frame"});
  EXPECT_EQ(text.find("<general"), std::string::npos);
}

/// A mesh of four triangles.
constexpr char kTetrahedron[] =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

/// A URDF of one moving link in a folder of its own, with a package beside it.
class UrdfMeshes : public testing::Test {
 protected:
  UrdfMeshes() {
    fs::create_directories(package_ / "meshes");
    WriteWholeFile(package_ / "meshes" / "link.obj", kTetrahedron);
    fs::create_directory(urdf_.parent_path());
    WriteWholeFile(urdf_.parent_path() / "near.obj", kTetrahedron);
  }

  /// Writes the URDF with these <visual> and <collision> elements.
  void Write(const std::string& shapes, const std::string& extension = "") {
    WriteWholeFile(urdf_, Arm(kInertial, shapes, extension));
  }

  static std::string Shape(const std::string& kind, const std::string& file) {
    return "<" + kind + "><geometry><mesh filename=\"" + file + "\"/></geometry></" + kind + ">";
  }

  const ScratchDirectory folder_;
  const fs::path package_ = folder_.path() / "ros" / "arm_description";
  const fs::path urdf_ = folder_.path() / "robot" / "arm.urdf";
};

TEST_F(UrdfMeshes, KeepWhatIsOnlyToBeSeen) {
  Write(Shape("visual", "near.obj") + "<visual><geometry><box size='1 1 1'/></geometry></visual>");
  const LoadedModel loaded = LoadModel(urdf_);
  EXPECT_THAT(loaded.notices, testing::IsEmpty());
  EXPECT_EQ(loaded.model->ngeom, 2);
  EXPECT_EQ(loaded.model->nmesh, 1);
  // seen, not touched, and without mass
  EXPECT_EQ(loaded.model->geom_contype[0], 0);
  EXPECT_EQ(loaded.model->body_mass[1], 2);
}

TEST_F(UrdfMeshes, ObeyAUrdfThatDiscardsItsVisuals) {
  Write(Shape("visual", "near.obj"), "<mujoco><compiler discardvisual=\"true\"/></mujoco>");
  EXPECT_EQ(LoadModel(urdf_).model->ngeom, 0);
}

TEST_F(UrdfMeshes, KeepVisualsBesideOtherSettingsOfTheUrdf) {
  for (const char* compiler : {"", "<compiler balanceinertia=\"true\"/>"}) {
    Write(Shape("visual", "near.obj"),
          "<mujoco><option timestep=\"0.003\"/>" + std::string(compiler) + "</mujoco>");
    const LoadedModel loaded = LoadModel(urdf_);
    EXPECT_EQ(loaded.model->ngeom, 1);
    EXPECT_EQ(loaded.model->opt.timestep, 0.003);
  }
}

TEST_F(UrdfMeshes, AreFoundInAPackageAlsoByTheWrittenModel) {
  Write(Shape("visual", "package://arm_description/meshes/link.obj") +
        Shape("collision", "package://arm_description/meshes/link.obj"));
  const fs::path out = folder_.path() / "out.xml";
  AttachOptions options;
  options.packages = {{"arm_description", package_}};
  const Attached attached = AttachFriction(urdf_, {{"hinge", test::LightFriction()}}, out, options);
  EXPECT_THAT(attached.notices, testing::Each(testing::Not(testing::HasSubstr("left out"))));
  const LoadedModel loaded = LoadModel(out);
  EXPECT_EQ(loaded.model->ngeom, 2);

  // both move together: nothing in the model names this machine
  EXPECT_THAT(ReadWholeFile(out), testing::Not(testing::HasSubstr(folder_.path())));
}

TEST_F(UrdfMeshes, AreLeftOutWithOneSentenceForEachReason) {
  WriteWholeFile(urdf_.parent_path() / "link.dae", "collada");
  Write(Shape("visual", "package://elsewhere/a.stl") + Shape("visual", "link.dae") +
        Shape("visual", "absent.stl") + Shape("visual", "near.obj"));
  const LoadedModel loaded = LoadModel(urdf_);
  ASSERT_EQ(loaded.notices.size(), 3);
  test::ExpectNamed(loaded.notices[0], {"a.stl", "--package elsewhere=FOLDER"});
  test::ExpectNamed(loaded.notices[1], {"link.dae"});
  test::ExpectNamed(loaded.notices[2], {"absent.stl"});
  EXPECT_EQ(loaded.model->ngeom, 1);
}

TEST_F(UrdfMeshes, RefuseAPackageThatLacksTheFile) {
  Write(Shape("visual", "package://arm_description/meshes/other.obj"));
  const PackageFolders folders{{"arm_description", package_}};
  test::ExpectNamed(test::RefusalOf([&] { ParseModel(urdf_, folders); }),
                    {urdf_, "other.obj", "--package arm_description="});
}

class MinimalModelOf : public testing::TestWithParam<JointKind> {};

TEST_P(MinimalModelOf, EitherKindRunsAndIsBraked) {
  const Friction friction{"asymmetric",
                          {{"viscous", 203.5}, {"coulomb_positive", 1}, {"coulomb_negative", 2}},
                          Thermal{-0.1, 60},
                          0,
                          50};
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "friction.xml", MinimalModel(friction, GetParam()));
  const LoadedModel loaded = LoadModel(scratch.path() / "friction.xml");
  const mjModel* m = loaded.model.get();
  EXPECT_EQ(m->jnt_type[0], GetParam() == JointKind::linear ? mjJNT_SLIDE : mjJNT_HINGE);

  const DataPtr data(mj_makeData(m));
  data->qvel[0] = -1;
  mj_step(m, data.get());
  // F = kv v - kc- at v = -1, by the law's own numbers
  EXPECT_DOUBLE_EQ(data->actuator_force[0], 203.5 + 2);
  EXPECT_GT(data->qvel[0], -1);
}

INSTANTIATE_TEST_SUITE_P(Joint, MinimalModelOf,
                         testing::Values(JointKind::rotary, JointKind::linear));

}  // namespace
}  // namespace warmjoint
