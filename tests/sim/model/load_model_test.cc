#include "sim/model/load_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/attach.h>

#include "models/foundation/atomic_file.h"
#include "tests/models/recording/temporary_file.h"
#include "tests/sim/model/light_friction.h"
#include "tests/sim/plugin/friction_models.h"
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

TEST(ModelToXml, KeepsEveryBit) {
  const SpecPtr spec = test::ParseXml(kModel);
  const ModelPtr a(mj_compile(spec.get(), nullptr));
  const SpecPtr again = test::ParseXml(ModelToXml(*spec, {}));
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
  const std::string text = ModelToXml(*test::ParseXml(kModel), {});
  test::ExpectNamed(text, {"euler=", "fromto=", "<position", "class=\"thin\"", "<frame"});
  EXPECT_EQ(text.find("<general"), std::string::npos);
}

/// A URDF of one moving link in a folder of its own, with a package beside it.
class UrdfMeshes : public testing::Test {
 protected:
  UrdfMeshes() {
    fs::create_directories(package_ / "meshes");
    WriteWholeFile(package_ / "meshes" / "link.obj", test::kTetrahedron);
    fs::create_directory(urdf_.parent_path());
    WriteWholeFile(urdf_.parent_path() / "near.obj", test::kTetrahedron);
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
  // and the hinge's limits
  EXPECT_EQ(loaded.model->jnt_range[0], -1);
  EXPECT_EQ(loaded.model->jnt_range[1], 1);
}

TEST_F(UrdfMeshes, ObeyTheSettingsOfTheUrdf) {
  const struct {
    std::string settings;
    int visuals;
    double timestep;
  } cases[] = {
      {R"(<compiler discardvisual="true"/>)", 0, 0.002},
      {R"(<option timestep="0.003"/>)", 1, 0.003},
      {R"(<option timestep="0.003"/><compiler balanceinertia="true"/>)", 1, 0.003},
  };
  for (const auto& [settings, visuals, timestep] : cases) {
    Write(Shape("visual", "near.obj"), "<mujoco>" + settings + "</mujoco>");
    const LoadedModel loaded = LoadModel(urdf_);
    EXPECT_EQ(loaded.model->ngeom, visuals) << settings;
    EXPECT_EQ(loaded.model->opt.timestep, timestep) << settings;
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

TEST(MinimalModel, OfEitherKindRunsAndIsBraked) {
  const Friction friction{"asymmetric",
                          {{"viscous", 203.5}, {"coulomb_positive", 1}, {"coulomb_negative", 2}},
                          Thermal{-0.1, 60},
                          0,
                          50};
  const ScratchDirectory scratch;
  for (const JointKind kind : {JointKind::rotary, JointKind::linear}) {
    WriteWholeFile(scratch.path() / "friction.xml", MinimalModel(friction, kind));
    const LoadedModel loaded = LoadModel(scratch.path() / "friction.xml");
    const mjModel* m = loaded.model.get();
    EXPECT_EQ(m->jnt_type[0], kind == JointKind::linear ? mjJNT_SLIDE : mjJNT_HINGE);

    const DataPtr data(mj_makeData(m));
    data->qvel[0] = -1;
    mj_step(m, data.get());
    // F = kv v - kc- at v = -1, by the law's own numbers
    EXPECT_DOUBLE_EQ(data->actuator_force[0], 203.5 + 2);
    EXPECT_GT(data->qvel[0], -1);
  }
}

}  // namespace
}  // namespace warmjoint
