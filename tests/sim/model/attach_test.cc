#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/attach.h>

#include <cmath>
#include <fstream>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "sim/model/load_model.h"
#include "sim/plugin/friction_instance.h"
#include "tests/models/recording/temporary_file.h"
#include "tests/sim/model/light_friction.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

namespace fs = std::filesystem;
using test::FrictionJoints;
using test::LightFriction;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

constexpr char kTwoJoints[] = R"(<mujoco>
  <option timestep="0.002"/>
  <worldbody>
    <body name="upper_arm" pos="0 0 1">
      <joint name="shoulder" axis="0 1 0" damping="0.3" frictionloss="1"/>
      <geom name="upper" type="capsule" fromto="0 0 0 0.3 0 0" size="0.04"/>
      <body pos="0.3 0 0">
        <joint name="elbow" axis="0 1 0" damping="0.2" actuatorfrcrange="-4 3"/>
        <geom name="lower" type="capsule" fromto="0 0 0 0.3 0 0" size="0.03"/>
        <body pos="0.3 0 0"><joint name="wrist" type="ball"/><geom size="0.03"/></body>
      </body>
    </body>
  </worldbody>
  <actuator><motor name="m" joint="elbow" forcerange="-2 9"/></actuator>
  <keyframe><key name="k" qpos="0.1 0.2 1 0 0 0" ctrl="0.5"/></keyframe>
</mujoco>
)";

class Attach : public testing::Test {
 protected:
  const ScratchDirectory folder_;
  const fs::path out_ = folder_.path() / "out.xml";
  const TemporaryFile two_joints_{"two.xml", kTwoJoints};
};

TEST_F(Attach, PutsFrictionOnTheNamedJointsAlone) {
  AttachFriction(two_joints_.path(), {{"elbow", LightFriction()}}, out_);
  const LoadedModel result = LoadModel(out_);
  EXPECT_THAT(FrictionJoints(result.model.get()), ElementsAre("elbow"));
  EXPECT_EQ(mj_name2id(result.model.get(), mjOBJ_ACTUATOR, "elbow_friction"), 1);
}

TEST_F(Attach, ReplacesTheFrictionOfTheModelOnThoseJoints) {
  const Attached attached =
      AttachFriction(two_joints_.path(), {{"shoulder", LightFriction()}}, out_);
  EXPECT_THAT(attached.notices, ElementsAre(AllOf(HasSubstr("shoulder"), HasSubstr("damping")),
                                            HasSubstr("'shoulder' by 0.029 mrad")));
  const LoadedModel result = LoadModel(out_);
  EXPECT_EQ(result.model->dof_damping[0], 0);
  EXPECT_EQ(result.model->dof_frictionloss[0], 0);
  EXPECT_EQ(result.model->dof_damping[1], 0.2);
}

TEST_F(Attach, TakesPatternsAndSeveralJointsAtOnce) {
  const Attached attached =
      AttachFriction(two_joints_.path(), {{"el.*|sh.*", LightFriction()}}, out_);
  EXPECT_THAT(attached.joints, ElementsAre("shoulder", "elbow"));
  EXPECT_THAT(FrictionJoints(LoadModel(out_).model.get()), ElementsAre("shoulder", "elbow"));
}

TEST_F(Attach, ChangesArmatureIntegratorAndStepWhereAsked) {
  AttachOptions options;
  options.armatures = {{".*", 0.01}, {"elbow", 0.0200000000000001}};
  options.integrator = mjINT_IMPLICITFAST;
  options.timestep = 0.0005;
  AttachFriction(two_joints_.path(), {{"elbow", LightFriction()}}, out_, options);
  const LoadedModel result = LoadModel(out_);
  EXPECT_EQ(result.model->dof_armature[0], 0.01);
  EXPECT_EQ(result.model->dof_armature[1], 0.0200000000000001);
  EXPECT_EQ(result.model->opt.integrator, mjINT_IMPLICITFAST);
  EXPECT_EQ(result.model->opt.timestep, 0.0005);
}

TEST_F(Attach, InheritsNothingFromTheActuatorDefaultsOfTheModel) {
  const std::string defaults =
      R"(<default><general ctrllimited="true" ctrlrange="-1 1" forcelimited="true"
      forcerange="-2 2" actlimited="true" actrange="0 1" gear="50" damping="3" armature="0.1"
      dyntype="filter" dynprm="0.1" group="3" actdim="1"/></default>)";
  std::string text = kTwoJoints;
  text.insert(text.find("<worldbody>"), defaults);
  text.replace(text.find("<motor"), 6, "<general");
  const TemporaryFile model("defaults.xml", text);
  AttachFriction(model.path(), {{"elbow", LightFriction()}, {"shoulder", LightFriction()}}, out_);
  const LoadedModel result = LoadModel(out_);
  const mjModel* m = result.model.get();
  ASSERT_EQ(m->nactuator, 3);
  for (int i = 1; i < 3; ++i) {
    EXPECT_FALSE(m->actuator_ctrllimited[i]);
    EXPECT_FALSE(m->actuator_forcelimited[i]);
    EXPECT_FALSE(m->actuator_actlimited[i]);
    EXPECT_EQ(m->actuator_dyntype[i], mjDYN_NONE);
    EXPECT_EQ(m->actuator_gear[6 * m->actuator_outadr[i]], 1);
    EXPECT_EQ(m->actuator_group[i], 0);
    EXPECT_EQ(m->actuator_armature[i], 0);
    EXPECT_EQ(m->actuator_damping[i], 0);
  }
  // the motor of the model keeps what it inherits
  EXPECT_EQ(m->actuator_armature[0], 0.1);
  EXPECT_EQ(m->actuator_gear[0], 50);
}

TEST_F(Attach, TakesAFileThatIsNamedWithoutItsFolder) {
  std::ofstream(folder_.path() / "t.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                                             "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
  std::ofstream(folder_.path() / "model.xml") << R"(<mujoco>
    <asset><mesh name="t" file="t.obj"/></asset>
    <worldbody><body><joint name="j"/><geom type="mesh" mesh="t"/></body></worldbody></mujoco>)";
  const fs::path before = fs::current_path();
  fs::current_path(folder_.path());
  EXPECT_NO_THROW(AttachFriction("model.xml", {{"j", LightFriction()}}, "out.xml"));
  fs::current_path(before);
  EXPECT_EQ(LoadModel(out_).model->nmesh, 1);
}

TEST_F(Attach, WorksOnReplicatedJoints) {
  const TemporaryFile model("replicate.xml", R"(<mujoco><worldbody>
    <replicate count="3" offset="0.5 0 0"><body><joint name="j" axis="0 1 0"/><geom size="0.1"/>
    </body></replicate></worldbody></mujoco>)");
  const Attached attached = AttachFriction(model.path(), {{"j.*", LightFriction()}}, out_);
  EXPECT_EQ(attached.joints.size(), 3u);
  EXPECT_EQ(FrictionJoints(LoadModel(out_).model.get()), attached.joints);
}

TEST_F(Attach, RefusesAJointThatSharesAnInstanceAlready) {
  AttachFriction(two_joints_.path(), {{".*", LightFriction()}}, out_);
  EXPECT_THAT(
      [&] {
        AttachFriction(out_, {{"elbow", LightFriction()}}, folder_.path() / "again.xml");
      },
      ThrowsMessage<BadInput>(HasSubstr("'elbow' has friction already, by actuator")));
}

TEST_F(Attach, LeavesActuatorsControlsAndLimitsAsTheyAreInThePassiveForm) {
  AttachOptions options;
  options.form = FrictionForm::passive;
  options.integrator = mjINT_RK4;
  const Attached attached =
      AttachFriction(two_joints_.path(), {{".*", LightFriction()}}, out_, options);
  EXPECT_THAT(attached.joints, ElementsAre("shoulder", "elbow"));
  const LoadedModel before = LoadModel(two_joints_.path()), after = LoadModel(out_);
  const mjModel *a = before.model.get(), *b = after.model.get();
  EXPECT_EQ(a->nu, b->nu);
  EXPECT_EQ(a->na, b->na);
  EXPECT_EQ(b->nplugin, 1);
  EXPECT_EQ(a->jnt_actfrcrange[2], b->jnt_actfrcrange[2]);
  EXPECT_EQ(a->actuator_forcerange[1], b->actuator_forcerange[1]);
  EXPECT_EQ(a->key_ctrl[0], b->key_ctrl[0]);

  // 0.5 N.m hold the elbow against 0.4 N.m, under RK4 too
  const DataPtr data(mj_makeData(b));
  after.model->opt.disableflags |= mjDSBL_GRAVITY;
  data->qfrc_applied[b->jnt_dofadr[1]] = 0.4;
  while (data->time < 1) mj_step(b, data.get());
  EXPECT_LT(std::abs(data->qvel[1]), 1e-6);
  data->qfrc_applied[b->jnt_dofadr[1]] = 0.6;
  while (data->time < 1.1) mj_step(b, data.get());
  EXPECT_GT(data->qvel[1], 0.1);
}

TEST_F(Attach, LetsTheRobotBePutIntoASceneWithAPrefix) {
  for (const FrictionForm form : {FrictionForm::actuator, FrictionForm::passive}) {
    AttachOptions options;
    options.form = form;
    AttachFriction(two_joints_.path(), {{".*", LightFriction()}}, out_, options);
    const fs::path scene = folder_.path() / "scene.xml";
    WriteWholeFile(scene, R"(<mujoco><asset><model name="arm" file="out.xml"/></asset><worldbody>
      <frame><attach model="arm" body="upper_arm" prefix="left/"/></frame>
      <frame pos="0 1 0"><attach model="arm" body="upper_arm" prefix="right/"/></frame>
      </worldbody></mujoco>)");
    const LoadedModel loaded = LoadModel(scene);
    EXPECT_EQ(loaded.model->nplugin, 2);
    EXPECT_GE(mj_name2id(loaded.model.get(), mjOBJ_JOINT, "right/elbow"), 0);
    const DataPtr data(mj_makeData(loaded.model.get()));
    EXPECT_TRUE(data);
  }
}

TEST_F(Attach, RefusesAPassiveFrictionBesideAnotherOne) {
  AttachOptions options;
  options.form = FrictionForm::passive;
  AttachFriction(two_joints_.path(), {{"elbow", LightFriction()}}, out_, options);
  for (const FrictionForm form : {FrictionForm::passive, FrictionForm::actuator}) {
    options.form = form;
    EXPECT_THAT(
        [&] {
          AttachFriction(out_, {{"elbow", LightFriction()}}, folder_.path() / "again.xml", options);
        },
        ThrowsMessage<BadInput>(
            HasSubstr("'elbow' has friction already, by plugin instance 'friction'")));
  }
}

TEST_F(Attach, KeepsKeyframesWithTheirControls) {
  AttachFriction(two_joints_.path(), {{"elbow", LightFriction()}, {"shoulder", LightFriction()}},
                 out_);
  const LoadedModel result = LoadModel(out_);
  ASSERT_EQ(result.model->nkey, 1);
  EXPECT_EQ(result.model->key_ctrl[0], 0.5);
  EXPECT_EQ(result.model->key_qpos[1], 0.2);
}

TEST_F(Attach, FindsMeshesInTheFolderOfTheOriginal) {
  const fs::path source = folder_.path() / "source" / "assets";
  fs::create_directories(source);
  std::ofstream(source / "t.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                                     "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
  const fs::path model = folder_.path() / "source" / "model.xml";
  std::ofstream(model) << R"(<mujoco><compiler meshdir="assets"/>
    <asset><mesh name="t" file="t.obj"/></asset>
    <worldbody><body><joint name="j"/><geom type="mesh" mesh="t"/></body></worldbody></mujoco>)";
  AttachFriction(model, {{"j", LightFriction()}}, out_);
  EXPECT_EQ(LoadModel(out_).model->nmesh, 1);
  EXPECT_THAT(ReadWholeFile(out_), HasSubstr("meshdir=\"source/assets"));
}

TEST_F(Attach, RefusesAnUnknownJointWithTheNearestAndWritesNothing) {
  EXPECT_THAT(
      [&] {
        AttachFriction(two_joints_.path(), {{"elbwo", LightFriction()}}, out_);
      },
      ThrowsMessage<BadInput>(AllOf(HasSubstr(two_joints_.path()),
                                    HasSubstr("no joint 'elbwo'; did you mean 'elbow'"))));
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(Attach, RefusesABallJointAndASecondFriction) {
  EXPECT_THAT(
      [&] {
        AttachFriction(two_joints_.path(), {{"wrist", LightFriction()}}, out_);
      },
      ThrowsMessage<BadInput>(HasSubstr("'wrist' is neither hinge nor slide")));
  EXPECT_THAT(
      [&] {
        AttachFriction(two_joints_.path(), {{"elbow", LightFriction()}, {"elbow", LightFriction()}},
                       out_);
      },
      ThrowsMessage<BadInput>(
          HasSubstr("'elbow' is given friction twice, by 'elbow' and by 'elbow'")));
  AttachFriction(two_joints_.path(), {{"elbow", LightFriction()}}, out_);
  EXPECT_THAT(
      [&] {
        AttachFriction(out_, {{"elbow", LightFriction()}}, folder_.path() / "again.xml");
      },
      ThrowsMessage<BadInput>(HasSubstr("by actuator 'elbow_friction'")));
}

TEST_F(Attach, RefusesWhatThePluginRefusesAndWritesNothing) {
  Friction steep = LightFriction();
  steep.law = "viscous_coulomb";
  steep.parameters = {{"viscous", 1e4}, {"coulomb", 1}};
  EXPECT_THAT(
      [&] {
        AttachFriction(two_joints_.path(), {{"elbow", steep}}, out_);
      },
      ThrowsMessage<BadInput>(AllOf(HasSubstr(two_joints_.path()), HasSubstr("armature"))));
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(Attach, EscapesNames) {
  const TemporaryFile file("odd.xml",
                           "<mujoco><worldbody><body><joint name='a&amp;&lt;&quot;b'/>"
                           "<geom size='0.1'/></body></worldbody></mujoco>");
  AttachFriction(file.path(), {{"a&<\"b", LightFriction()}}, out_);
  EXPECT_THAT(FrictionJoints(LoadModel(out_).model.get()), ElementsAre("a&<\"b"));
}

}  // namespace
}  // namespace warmjoint
