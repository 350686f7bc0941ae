#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/attach.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "models/foundation/atomic_file.h"
#include "sim/model/load_model.h"
#include "tests/models/recording/temporary_file.h"
#include "tests/sim/model/light_friction.h"
#include "tests/sim/plugin/friction_robots.h"
#include "tests/support/refusal.h"
#include "tests/support/shared_data.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

namespace fs = std::filesystem;
using test::FrictionJoints;
using test::LightFriction;
using testing::ElementsAre;
using testing::HasSubstr;

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
  /// Light friction onto joints of a model; what was attached.
  Attached To(const fs::path& model, const std::vector<std::string>& joints,
              const AttachOptions& options = {}) const {
    std::vector<FrictionForJoint> frictions;
    for (const std::string& joint : joints) frictions.push_back({joint, LightFriction()});
    return AttachFriction(model, frictions, out_, options);
  }

  const ScratchDirectory folder_;
  const fs::path out_ = folder_.path() / "out.xml";
  const TemporaryFile two_joints_{"two.xml", kTwoJoints};
};

TEST_F(Attach, TakesPatternsAndKeepsKeyframesWithTheirControls) {
  EXPECT_THAT(To(two_joints_.path(), {"el.*|sh.*"}).joints, ElementsAre("shoulder", "elbow"));
  const LoadedModel result = LoadModel(out_);
  EXPECT_THAT(FrictionJoints(result.model.get()), ElementsAre("shoulder", "elbow"));
  ASSERT_EQ(result.model->nkey, 1);
  EXPECT_EQ(result.model->key_ctrl[0], 0.5);
  EXPECT_EQ(result.model->key_qpos[1], 0.2);
}

TEST_F(Attach, ReplacesTheFrictionOfTheModelOnThoseJoints) {
  const Attached attached = To(two_joints_.path(), {"shoulder"});
  ASSERT_EQ(attached.notices.size(), 2);
  test::ExpectNamed(attached.notices[0], {"shoulder", "damping"});
  test::ExpectNamed(attached.notices[1], {"'shoulder' by 0.03", " mrad"});
  const LoadedModel result = LoadModel(out_);
  EXPECT_EQ(result.model->dof_damping[0], 0);
  EXPECT_EQ(result.model->dof_frictionloss[0], 0);
  EXPECT_EQ(result.model->dof_damping[1], 0.2);
}

TEST_F(Attach, GivesAJointTheLastArmatureThatMeansIt) {
  AttachOptions options;
  options.armatures = {{".*", 0.01}, {"elbow", 0.0200000000000001}};
  To(two_joints_.path(), {"elbow"}, options);
  const LoadedModel result = LoadModel(out_);
  EXPECT_EQ(result.model->dof_armature[0], 0.01);
  EXPECT_EQ(result.model->dof_armature[1], 0.0200000000000001);
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
  To(model.path(), {"elbow", "shoulder"});
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
  std::ofstream(folder_.path() / "t.obj") << test::kTetrahedron;
  std::ofstream(folder_.path() / "model.xml") << R"(<mujoco>
    <asset><mesh name="t" file="t.obj"/></asset>
    <worldbody><body><joint name="j"/><geom type="mesh" mesh="t"/></body></worldbody></mujoco>)";
  const fs::path before = fs::current_path();
  fs::current_path(folder_.path());
  EXPECT_NO_THROW(AttachFriction("model.xml", {{"j", LightFriction()}}, "out.xml"));
  fs::current_path(before);
  EXPECT_EQ(LoadModel(out_).model->nmesh, 1);
}

TEST_F(Attach, WorksWhereTheCompilerLooksForLengthRangesOfActuators) {
  const TemporaryFile muscle("muscle.xml", R"(<mujoco><worldbody><site name="a" pos="0 0 .3"/>
    <body><joint name="j" axis="0 1 0" range="-60 60" limited="true" armature=".01"/>
    <geom type="capsule" size=".02" fromto="0 0 0 .3 0 0"/><site name="b" pos=".2 0 .02"/></body>
    </worldbody><tendon><spatial name="t"><site site="a"/><site site="b"/></spatial></tendon>
    <actuator><muscle name="m" tendon="t"/></actuator></mujoco>)");
  const TemporaryFile all("all.xml", R"(<mujoco><compiler><lengthrange mode="all"/></compiler>
    <worldbody><body><joint name="j" axis="0 1 0" range="-60 60" limited="true" armature=".01"/>
    <geom type="capsule" size=".02" fromto="0 0 0 .3 0 0"/></body></worldbody>
    <actuator><motor name="m" joint="j"/></actuator></mujoco>)");
  const Friction friction{"viscous_coulomb", {{"viscous", 0}, {"coulomb", 0.001}}, {}};
  for (const TemporaryFile* model : {&muscle, &all}) {
    for (const FrictionForm form : {FrictionForm::actuator, FrictionForm::passive}) {
      AttachFriction(model->path(), {{"j", friction}}, out_, {.form = form});
      const LoadedModel result = LoadModel(out_);
      const DataPtr d(mj_makeData(result.model.get()));
      for (int i = 0; i < 100; ++i) mj_step(result.model.get(), d.get());
      EXPECT_GT(result.model->actuator_lengthrange[1], result.model->actuator_lengthrange[0]);
    }
  }
}

TEST_F(Attach, NamesWhatElseResistsTheJoint) {
  const TemporaryFile model("others.xml", R"(<mujoco><worldbody>
    <body><joint name="a" axis="0 1 0" armature=".05"/><geom size=".1"/></body>
    <body pos="1 0 0"><joint name="b" axis="0 1 0" armature=".05"/><geom size=".1"/></body></worldbody>
    <tendon><fixed name="t" frictionloss="1"><joint joint="b" coef="2"/></fixed>
      <fixed name="free"><joint joint="b" coef="1"/></fixed></tendon>
    <actuator><motor joint="b" damping="3"/>
      <dcmotor joint="a" motorconst="1" resistance="1" lugre="1e4 1 .1 .2 .05"/></actuator></mujoco>)");
  const Attached attached = To(model.path(), {"a", "b"});
  std::string all;
  for (const std::string& notice : attached.notices) all += notice + "\n";
  test::ExpectNamed(all, {"b: damping of the actuators was removed",
                          "b: frictionloss of tendon 't'", "a: the friction of the dcmotor"});
  EXPECT_EQ(all.find("'free'"), std::string::npos);
  EXPECT_EQ(LoadModel(out_).model->actuator_damping[0], 0);
}

TEST_F(Attach, TakesTheSpringThatYieldsAndKeepsKeyframesAndOtherSprings) {
  const TemporaryFile model("plastic.xml", R"(<mujoco><compiler angle="radian"/><worldbody>
    <body><joint name="a" axis="0 1 0" armature=".05" stiffness="200" springyield="1e-2"/><geom size=".1"/></body>
    <body pos="1 0 0"><joint name="b" axis="0 1 0" armature=".05" stiffness="3"/><geom size=".1"/></body>
    <body pos="2 0 0"><joint name="c" axis="0 1 0" armature=".05" stiffness="2" springyield=".1"/><geom size=".1"/></body></worldbody>
    <tendon><fixed name="t" stiffness="2" springyield=".1"><joint joint="b" coef="1"/></fixed></tendon>
    <keyframe><key plastic=".001 .02 .03"/></keyframe></mujoco>)");
  const Attached attached = To(model.path(), {"a", "b"});
  std::string all;
  for (const std::string& notice : attached.notices) all += notice + "\n";
  test::ExpectNamed(
      all, {"a: the stiffness of the model's spring with a yield was removed",
            "b: the spring with a yield of tendon 't' acts on it besides its friction, and stays"});
  const LoadedModel result = LoadModel(out_);
  EXPECT_EQ(result.model->jnt_stiffness[0], 0);
  EXPECT_EQ(result.model->jnt_stiffness[1], 3);
  EXPECT_EQ(result.model->jnt_stiffness[2], 2);
  ASSERT_EQ(result.model->nplastic, LoadModel(model.path()).model->nplastic);
  EXPECT_EQ(result.model->key_plastic[1], .02);
}

TEST_F(Attach, GivesAFrictionToJointsOfItsKindAlone) {
  const TemporaryFile model("gantry.xml", R"(<mujoco><worldbody>
    <body><joint name="axis_1" type="slide" axis="1 0 0" armature="1"/><geom size=".1"/></body>
    <body pos="1 0 0"><joint name="axis_2" axis="0 1 0" armature=".05"/><geom size=".1"/></body>
    </worldbody></mujoco>)");
  AttachOptions options;
  options.kinds = {{"axis_.*", JointKind::rotary}, {"axis_1", JointKind::rotary}};
  const Attached attached = To(model.path(), {"axis_.*"}, options);
  EXPECT_THAT(attached.joints, ElementsAre("axis_2"));
  test::ExpectNamed(attached.notices.front(), {"axis_1", "left out", "hinges (rad, N.m)"});
  test::ExpectNamed(test::RefusalOf([&] { To(model.path(), {"axis_1"}, options); }),
                    {"axis_1", "slides (m, N)", "hinges"});
  EXPECT_EQ(KindOfUnits({{"coulomb", "N"}}), JointKind::linear);
  EXPECT_EQ(KindOfUnits({{"viscous", "N.m.s/rad"}}), JointKind::rotary);
  EXPECT_EQ(KindOfUnits({{"coulomb", "A"}}), std::nullopt);
}

TEST_F(Attach, WorksOnReplicatedJoints) {
  const TemporaryFile model("replicate.xml", R"(<mujoco><worldbody>
    <replicate count="3" offset="0.5 0 0"><body><joint name="j" axis="0 1 0"/><geom size="0.1"/>
    </body></replicate></worldbody></mujoco>)");
  const Attached attached = To(model.path(), {"j.*"});
  EXPECT_EQ(attached.joints.size(), 3u);
  EXPECT_EQ(FrictionJoints(LoadModel(out_).model.get()), attached.joints);
}

TEST_F(Attach, LeavesActuatorsControlsAndLimitsAsTheyAreInThePassiveForm) {
  AttachOptions options;
  options.form = FrictionForm::passive;
  const Attached attached = To(two_joints_.path(), {".*"}, options);
  EXPECT_THAT(attached.joints, ElementsAre("shoulder", "elbow"));
  const LoadedModel before = LoadModel(two_joints_.path()), after = LoadModel(out_);
  const mjModel *a = before.model.get(), *b = after.model.get();
  EXPECT_EQ(a->nu, b->nu);
  EXPECT_EQ(a->na, b->na);
  EXPECT_EQ(b->nplugin, 1);
  EXPECT_EQ(a->jnt_actfrcrange[2], b->jnt_actfrcrange[2]);
  EXPECT_EQ(a->actuator_forcerange[1], b->actuator_forcerange[1]);
  EXPECT_EQ(a->key_ctrl[0], b->key_ctrl[0]);
}

TEST_F(Attach, WritesSensorsAndNumbersThatChangeNothing) {
  for (const FrictionForm form : {FrictionForm::actuator, FrictionForm::passive}) {
    for (const std::string joints : {"elbow", ".*"}) {
      To(two_joints_.path(), {joints}, {.form = form});
      const LoadedModel plain = LoadModel(out_);
      const Attached attached =
          To(two_joints_.path(), {joints}, {.form = form, .sensors = true, .numbers = true});
      const LoadedModel loaded = LoadModel(out_);
      const mjModel *a = plain.model.get(), *b = loaded.model.get();
      const size_t count = attached.joints.size();
      const DataPtr c(mj_makeData(a)), d(mj_makeData(b));
      for (int i = 0; i < 200; ++i) mj_step(a, c.get()), mj_step(b, d.get());
      EXPECT_EQ(c->qpos[1], d->qpos[1]);

      // a sensor for each joint, an entry for each in every array
      for (const std::string& joint : attached.joints) {
        const int sensor = mj_name2id(b, mjOBJ_SENSOR, (joint + "_friction").c_str());
        ASSERT_GE(sensor, 0);
        EXPECT_NE(d->sensordata[b->sensor_adr[sensor]], 0);
      }
      for (const char* number : {"coulomb", "thermal_gain", "thermal_time_constant",
                                 "viscous_per_energy", "initial_energy"}) {
        const int array = mj_name2id(b, mjOBJ_NUMERIC, (std::string("friction/") + number).c_str());
        ASSERT_GE(array, 0) << number;
        EXPECT_EQ(b->numeric_size[array], static_cast<int>(count));
      }
      EXPECT_EQ(b->nnumeric, 5);
      EXPECT_EQ(b->numeric_data[0], 0.5);
    }
  }
}

TEST_F(Attach, LetsTheRobotMoveInASceneUnderAPrefixAsAlone) {
  for (const FrictionForm form : {FrictionForm::actuator, FrictionForm::passive}) {
    AttachOptions options;
    options.form = form;
    To(two_joints_.path(), {".*"}, options);
    const fs::path scene = folder_.path() / "scene.xml";
    WriteWholeFile(scene, R"(<mujoco><option timestep="0.002"/>
      <asset><model name="arm" file="out.xml"/></asset><worldbody>
      <frame><attach model="arm" body="upper_arm" prefix="left/"/></frame>
      <frame pos="0 1 0"><attach model="arm" body="upper_arm" prefix="right/"/></frame>
      <body pos="0 3 0"><joint name="shoulder" axis="0 1 0"/><geom size="0.1"/>
      <body><joint name="elbow" axis="0 1 0"/><geom pos="0.2 0 0" size="0.1"/></body></body>
      </worldbody></mujoco>)");
    // joints of the scene's own, which have the robot's names, are not meant
    const LoadedModel alone = LoadModel(out_), two = LoadModel(scene);
    ASSERT_EQ(two.model->nplugin, 2);
    EXPECT_GE(mj_name2id(two.model.get(), mjOBJ_JOINT, "right/elbow"), 0);
    const DataPtr a(mj_makeData(alone.model.get())), b(mj_makeData(two.model.get()));
    for (int i = 0; i < 200; ++i) {
      mj_step(alone.model.get(), a.get());
      mj_step(two.model.get(), b.get());
    }
    const int nq = static_cast<int>(alone.model->nq);
    for (int k = 0; k < 2; ++k) {
      EXPECT_NEAR(b->qpos[k], a->qpos[k], 1e-12);
      EXPECT_NEAR(b->qpos[nq + k], a->qpos[k], 1e-12);
    }
  }
}

TEST_F(Attach, FindsMeshesInTheFolderOfTheOriginal) {
  const fs::path source = folder_.path() / "source" / "assets";
  fs::create_directories(source);
  std::ofstream(source / "t.obj") << test::kTetrahedron;
  const fs::path model = folder_.path() / "source" / "model.xml";
  std::ofstream(model) << R"(<mujoco><compiler meshdir="assets"/>
    <asset><mesh name="t" file="t.obj"/></asset>
    <worldbody><body><joint name="j"/><geom type="mesh" mesh="t"/></body></worldbody></mujoco>)";
  To(model, {"j"});
  EXPECT_EQ(LoadModel(out_).model->nmesh, 1);
  EXPECT_THAT(ReadWholeFile(out_), HasSubstr("meshdir=\"source/assets"));
}

TEST_F(Attach, EscapesNames) {
  const TemporaryFile file("odd.xml",
                           "<mujoco><worldbody><body><joint name='a&amp;&lt;&quot;b'/>"
                           "<geom size='0.1'/></body></worldbody></mujoco>");
  To(file.path(), {"a&<\"b"});
  EXPECT_THAT(FrictionJoints(LoadModel(out_).model.get()), ElementsAre("a&<\"b"));
}

TEST_F(Attach, RefusesAJointThatCannotCarryFrictionAndWritesNothing) {
  Friction strong = LightFriction();
  strong.parameters = {{"coulomb", 1e6}};
  const Friction light = LightFriction();
  const struct {
    std::vector<FrictionForJoint> frictions;
    std::vector<std::string> names;
  } cases[] = {
      {{{"elbwo", light}}, {"'elbwo'", "did you mean 'elbow'"}},
      {{{"wrist", light}}, {"'wrist'", "neither hinge nor slide"}},
      {{{"elbow", light}, {"el.*", light}}, {"'elbow'", "twice", "by 'elbow' and by 'el.*'"}},
      {{{"elbow", strong}}, {"--armature elbow=", "--timestep"}},
  };
  for (const auto& [frictions, names] : cases) {
    const std::string refusal =
        test::RefusalOf([&] { AttachFriction(two_joints_.path(), frictions, out_); });
    test::ExpectNamed(refusal, names);
    test::ExpectNamed(refusal, {two_joints_.path()});
    EXPECT_TRUE(fs::is_empty(folder_.path()));
  }
}

TEST_F(Attach, RefusesASecondFrictionByTheFirst) {
  const struct {
    std::vector<std::string> first;
    FrictionForm form;
    std::string name;
  } cases[] = {{{"elbow"}, FrictionForm::actuator, "actuator 'elbow_friction'"},
               {{".*"}, FrictionForm::actuator, "actuator 'elbow_friction'"},
               {{"elbow"}, FrictionForm::passive, "plugin instance 'friction'"}};
  for (const auto& [first, form, name] : cases) {
    AttachOptions options;
    options.form = form;
    To(two_joints_.path(), first, options);
    for (const FrictionForm second : {FrictionForm::passive, FrictionForm::actuator}) {
      options.form = second;
      const auto again = [&] {
        AttachFriction(out_, {{"elbow", LightFriction()}}, folder_.path() / "again.xml", options);
      };
      test::ExpectNamed(test::RefusalOf(again), {"'elbow' has friction already", name});
    }
  }
}

/// Effort limits of a joint `j` of -4 to 3 N.m, which would clip a friction that is an actuator, too.
TEST_F(Attach, GivesEffortLimitsToTheActuatorsThatDriveTheJoint) {
  const struct {
    std::string actuators;
    std::vector<double> ranges;       // of the actuators' forces, two of each; 0: none
    std::vector<std::string> notice;  // names
  } cases[] = {
      {R"(<motor joint="j" forcerange="-2 9"/>)", {-2, 3}, {"j: "}},
      {R"(<motor joint="j" gear="-2"/>)", {-1.5, 2}, {"j: "}},
      {R"(<position joint="j"/><velocity joint="j"/><motor joint="free"/>)",
       {-4, 3, -4, 3, 0, 0},
       {"j: ", "sum"}},
      {"", {}, {"j (-4 to 3)", "forcerange"}},
  };
  for (const auto& [actuators, ranges, notice] : cases) {
    const TemporaryFile model("limited.xml", R"(<mujoco><worldbody><body>
      <joint name="j" axis="0 1 0" actuatorfrcrange="-4 3"/><geom size="0.1"/>
      <body><joint name="free"/><geom size="0.1"/></body></body></worldbody><actuator>)" +
                                                 actuators + "</actuator></mujoco>");
    test::ExpectNamed(To(model.path(), {"j"}).notices.front(), notice);
    const LoadedModel result = LoadModel(out_);
    const mjModel* m = result.model.get();
    EXPECT_FALSE(m->jnt_actfrclimited[0]);
    EXPECT_EQ(m->nactuator, static_cast<int>(ranges.size() / 2) + 1);
    for (size_t i = 0; i < ranges.size(); ++i) EXPECT_EQ(m->actuator_forcerange[i], ranges[i]);

    // of a joint without limit they stay
    EXPECT_EQ(To(model.path(), {"free"}).notices.size(), 1);
    EXPECT_TRUE(LoadModel(out_).model->jnt_actfrclimited[0]);
  }
}

/// Friction of at most 0.5 N.m, less on joints too light to stick with that at the model's step.
std::vector<FrictionForJoint> EveryJoint(const mjModel* m) {
  std::vector<FrictionForJoint> all;
  for (int i = 0; i < m->njnt; ++i) {
    Friction friction = LightFriction();
    const double inertia = 1 / m->dof_invweight0[m->jnt_dofadr[i]];
    double& level = friction.parameters["coulomb"];
    level = std::min(level, 1e-3 * inertia / (m->opt.timestep * m->opt.timestep));
    all.push_back({mj_id2name(m, mjOBJ_JOINT, i), friction});
  }
  return all;
}

class AttachToRobot : public testing::TestWithParam<test::RobotCase> {};

TEST_P(AttachToRobot, EveryJointCarriesFrictionAndTheRestStays) {
  const fs::path robot = fs::path("robots") / GetParam().file;
  WARMJOINT_NEED_SHARED(robot);
  const ScratchDirectory folder;
  const LoadedModel before = LoadModel(test::SharedFolder() / robot);
  AttachFriction(test::SharedFolder() / robot, EveryJoint(before.model.get()),
                 folder.path() / "out.xml");
  const LoadedModel after = LoadModel(folder.path() / "out.xml");
  const mjModel* m = after.model.get();
  EXPECT_EQ(FrictionJoints(m).size(), static_cast<size_t>(m->njnt));
  EXPECT_EQ(m->nplugin, 1) << "all joints share one instance";

  const DataPtr data(mj_makeData(m));
  for (int i = 0; i < 1000; ++i) mj_step(m, data.get());
  EXPECT_EQ(data->warning[mjWARN_BADQACC].number, 0);
  for (int i = 0; i < m->nv; ++i) EXPECT_TRUE(std::isfinite(data->qvel[i]));
  // one step of the bristle is bounded by the level, so the loss has warmed at least one joint
  double warmest = 0;
  for (int i = 0; i < m->na; ++i) warmest = std::max(warmest, std::abs(data->act[i]));
  EXPECT_GT(warmest, 0);

  // the rest of the model stays
  const mjModel *a = before.model.get(), *b = m;
  ASSERT_EQ(a->nbody, b->nbody);
  ASSERT_EQ(a->nv, b->nv);
  EXPECT_EQ(a->ngeom, b->ngeom);
  EXPECT_EQ(a->opt.timestep, b->opt.timestep);
  EXPECT_EQ(a->opt.integrator, b->opt.integrator);
  for (int i = 0; i < a->nbody; ++i) EXPECT_EQ(a->body_mass[i], b->body_mass[i]);
  for (int i = 0; i < 3 * a->nbody; ++i) EXPECT_EQ(a->body_ipos[i], b->body_ipos[i]);
  for (int i = 0; i < 3 * a->nbody; ++i) EXPECT_EQ(a->body_inertia[i], b->body_inertia[i]);
  for (int i = 0; i < 3 * a->njnt; ++i) EXPECT_EQ(a->jnt_axis[i], b->jnt_axis[i]);
  for (int i = 0; i < 2 * a->njnt; ++i) EXPECT_EQ(a->jnt_range[i], b->jnt_range[i]);
  for (int i = 0; i < a->nv; ++i) EXPECT_EQ(a->dof_armature[i], b->dof_armature[i]);
}

INSTANTIATE_TEST_SUITE_P(SharedRobots, AttachToRobot, testing::ValuesIn(test::kRobots),
                         [](const auto& robot) { return robot.param.name(); });

}  // namespace
}  // namespace warmjoint
