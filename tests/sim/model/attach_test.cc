#include "sim/model/attach.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "models/robots/robot_list.h"
#include "sim/model/load_model.h"
#include "sim/plugin/friction_instance.h"
#include "tests/models/recording/temporary_file.h"
#include "tests/support/shared_data.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

FrictionDescription Light() {
  FrictionDescription friction;
  friction.law = "coulomb";
  friction.parameters = {{"coulomb", 0.5}};
  friction.thermal = Thermal{-0.1, 60};
  return friction;
}

std::vector<std::string> FrictionJoints(const mjModel* m) {
  std::vector<std::string> joints;
  for (int i = 0; i < m->nactuator; ++i) {
    if (m->actuator_plugin[i] < 0) continue;
    joints.emplace_back(mj_id2name(m, mjOBJ_JOINT, m->actuator_trnid[2 * i]));
  }
  return joints;
}

constexpr char kTwoJoints[] = R"(<mujoco>
  <option timestep="0.002"/>
  <worldbody>
    <body pos="0 0 1">
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
  AttachFriction(two_joints_.path(), {{"elbow", Light()}}, out_);
  const LoadedModel result = LoadModel(out_);
  EXPECT_THAT(FrictionJoints(result.model.get()), ElementsAre("elbow"));
  EXPECT_EQ(mj_name2id(result.model.get(), mjOBJ_ACTUATOR, "elbow_friction"), 1);
}

TEST_F(Attach, ReplacesTheFrictionOfTheModelOnThoseJoints) {
  const auto notices = AttachFriction(two_joints_.path(), {{"shoulder", Light()}}, out_);
  EXPECT_THAT(notices, ElementsAre(AllOf(HasSubstr("shoulder"), HasSubstr("damping"))));
  const LoadedModel result = LoadModel(out_);
  EXPECT_EQ(result.model->dof_damping[0], 0);
  EXPECT_EQ(result.model->dof_frictionloss[0], 0);
  EXPECT_EQ(result.model->dof_damping[1], 0.2);
}

TEST_F(Attach, MovesTheEffortLimitToTheMotor) {
  AttachFriction(two_joints_.path(), {{"elbow", Light()}}, out_);
  const LoadedModel result = LoadModel(out_);
  EXPECT_FALSE(result.model->jnt_actfrclimited[1]);
  // the motor's own range -2 to 9, cut to the joint's -4 to 3
  EXPECT_EQ(result.model->actuator_forcerange[0], -2);
  EXPECT_EQ(result.model->actuator_forcerange[1], 3);
}

TEST_F(Attach, GivesAUrdfJointAMotorWithItsEffort) {
  const RobotInfo pendulum = [] {
    for (const RobotInfo& robot : Robots()) {
      if (robot.name == "pendulum") return robot;
    }
    return RobotInfo{};
  }();
  AttachFriction(pendulum.urdf, {{"hinge", Light()}}, out_);
  const LoadedModel result = LoadModel(out_);
  const int motor = mj_name2id(result.model.get(), mjOBJ_ACTUATOR, "hinge");
  ASSERT_GE(motor, 0);
  EXPECT_EQ(result.model->actuator_forcerange[2 * motor + 1], pendulum.joints[0].effort);
}

TEST_F(Attach, KeepsKeyframesWithTheirControls) {
  AttachFriction(two_joints_.path(), {{"elbow", Light()}, {"shoulder", Light()}}, out_);
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
  AttachFriction(model, {{"j", Light()}}, out_);
  EXPECT_EQ(LoadModel(out_).model->nmesh, 1);
  EXPECT_THAT(ReadWholeFile(out_), HasSubstr("meshdir=\"source/assets"));
}

TEST_F(Attach, RefusesAnUnknownJointWithTheNearestAndWritesNothing) {
  EXPECT_THAT(
      [&] {
        AttachFriction(two_joints_.path(), {{"elbwo", Light()}}, out_);
      },
      ThrowsMessage<BadInput>(AllOf(HasSubstr(two_joints_.path()),
                                    HasSubstr("no joint 'elbwo'; did you mean 'elbow'"))));
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(Attach, RefusesABallJointAndASecondFriction) {
  EXPECT_THAT(
      [&] {
        AttachFriction(two_joints_.path(), {{"wrist", Light()}}, out_);
      },
      ThrowsMessage<BadInput>(HasSubstr("'wrist' is neither hinge nor slide")));
  EXPECT_THAT(
      [&] {
        AttachFriction(two_joints_.path(), {{"elbow", Light()}, {"elbow", Light()}}, out_);
      },
      ThrowsMessage<BadInput>(HasSubstr("'elbow' has friction already")));
  AttachFriction(two_joints_.path(), {{"elbow", Light()}}, out_);
  EXPECT_THAT(
      [&] {
        AttachFriction(out_, {{"elbow", Light()}}, folder_.path() / "again.xml");
      },
      ThrowsMessage<BadInput>(HasSubstr("by actuator 'elbow_friction'")));
}

TEST_F(Attach, RefusesWhatThePluginRefusesAndWritesNothing) {
  FrictionDescription steep = Light();
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
  AttachFriction(file.path(), {{"a&<\"b", Light()}}, out_);
  EXPECT_THAT(FrictionJoints(LoadModel(out_).model.get()), ElementsAre("a&<\"b"));
}

/// A robot file of the shared folder.
struct RobotFile {
  std::string name;
  fs::path path;
};
void PrintTo(const RobotFile& file, std::ostream* stream) { *stream << file.name; }

std::vector<RobotFile> RobotFiles() {
  std::vector<RobotFile> files;
  std::error_code absent;
  for (const auto& folder : fs::directory_iterator(test::SharedFolder() / "robots", absent)) {
    for (const auto& file : fs::directory_iterator(folder)) {
      const std::string extension = file.path().extension();
      if (extension != ".xml" && extension != ".urdf") continue;
      files.push_back({folder.path().filename(), file.path()});
    }
  }
  return files;
}

class AttachToRobot : public testing::TestWithParam<RobotFile> {
 protected:
  const fs::path& robot_ = GetParam().path;
  const ScratchDirectory folder_;
  const fs::path out_ = folder_.path() / "out.xml";

  /// Friction of at most 0.5 N.m, less on joints too light to stick with that at the model's step.
  std::vector<FrictionForJoint> EveryJoint(const mjModel* m) {
    std::vector<FrictionForJoint> all;
    for (int i = 0; i < m->njnt; ++i) {
      FrictionDescription friction = Light();
      const double inertia = 1 / m->dof_invweight0[m->jnt_dofadr[i]];
      double& level = friction.parameters["coulomb"];
      level = std::min(level, 1e-3 * inertia / (m->opt.timestep * m->opt.timestep));
      all.push_back({mj_id2name(m, mjOBJ_JOINT, i), friction});
    }
    return all;
  }
};

TEST_P(AttachToRobot, EveryJointCarriesFrictionAndTheRobotRuns) {
  const LoadedModel before = LoadModel(robot_);
  AttachFriction(robot_, EveryJoint(before.model.get()), out_);
  const LoadedModel after = LoadModel(out_);
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
}

TEST_P(AttachToRobot, TheRestOfTheModelStays) {
  const LoadedModel before = LoadModel(robot_);
  AttachFriction(robot_, EveryJoint(before.model.get()), out_);
  const LoadedModel after = LoadModel(out_);
  const mjModel *a = before.model.get(), *b = after.model.get();
  ASSERT_EQ(a->nbody, b->nbody);
  ASSERT_EQ(a->nv, b->nv);
  EXPECT_EQ(a->ngeom, b->ngeom);
  EXPECT_EQ(a->opt.timestep, b->opt.timestep);
  EXPECT_EQ(a->opt.integrator, b->opt.integrator);
  // six significant digits: at most half a unit of the sixth, 5e-6 of the value
  const auto near = [](double x, double y) { EXPECT_NEAR(x, y, 5e-6 * (1 + std::abs(x))); };
  for (int i = 0; i < a->nbody; ++i) near(a->body_mass[i], b->body_mass[i]);
  for (int i = 0; i < 3 * a->nbody; ++i) near(a->body_ipos[i], b->body_ipos[i]);
  for (int i = 0; i < 3 * a->nbody; ++i) near(a->body_inertia[i], b->body_inertia[i]);
  for (int i = 0; i < 3 * a->njnt; ++i) near(a->jnt_axis[i], b->jnt_axis[i]);
  for (int i = 0; i < 2 * a->njnt; ++i) near(a->jnt_range[i], b->jnt_range[i]);
  for (int i = 0; i < a->nv; ++i) near(a->dof_armature[i], b->dof_armature[i]);
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(AttachToRobot);
INSTANTIATE_TEST_SUITE_P(SharedRobots, AttachToRobot, testing::ValuesIn(RobotFiles()),
                         [](const auto& robot) { return robot.param.name; });

}  // namespace
}  // namespace warmjoint
