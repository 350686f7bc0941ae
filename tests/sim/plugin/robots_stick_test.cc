// Friction on every joint of robots that people know.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "models/foundation/bad_input.h"
#include "models/foundation/random_stream.h"
#include "sim/friction_actuator.h"
#include "sim/load_model.h"
#include "sim/spec_elements.h"
#include "tests/support/shared_data.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// A robot of the shared folder without actuators, and a pose within its limits.
struct Robot {
  std::string path;
  SpecPtr spec;
  std::vector<double> pose;   // [nq] rad or m
  std::vector<double> level;  // [nv] 1.5 times the gravity load at the pose, and 2 N.m or N
};

Robot LoadRobot(const std::string& file, double armature) {
  Robot robot{(test::SharedFolder() / "robots" / file).string(), nullptr, {}, {}};
  robot.spec = ParseModel(robot.path).spec;
  for (const mjtObj type :
       {mjOBJ_KEY, mjOBJ_SENSOR, mjOBJ_ACTUATOR, mjOBJ_EQUALITY, mjOBJ_TENDON}) {
    for (mjsElement* element : SpecElements(*robot.spec, type)) {
      mjs_delete(robot.spec.get(), element);
    }
  }
  for (mjsElement* element : SpecElements(*robot.spec, mjOBJ_JOINT)) {
    mjsJoint* joint = mjs_asJoint(element);
    joint->actfrclimited = mjLIMITED_FALSE;
    joint->frictionloss = 0;
    joint->armature = std::max(joint->armature, armature);
  }
  robot.spec->option.disableflags |= mjDSBL_CONTACT;

  // a pose drawn from the middle nine tenths of each range
  const ModelPtr m = CompileModel(*robot.spec, {robot.path});
  const DataPtr d(mj_makeData(m.get()));
  RandomStream random({1, 0}, Stream::test);
  for (int i = 0; i < m->njnt; ++i) {
    const double lower = m->jnt_limited[i] ? m->jnt_range[2 * i] : -3;
    const double upper = m->jnt_limited[i] ? m->jnt_range[2 * i + 1] : 3;
    d->qpos[i] = random.Uniform(lower + 0.05 * (upper - lower), upper - 0.05 * (upper - lower));
  }
  mj_forward(m.get(), d.get());
  robot.pose.assign(d->qpos, d->qpos + m->nq);
  for (int i = 0; i < m->nv; ++i) robot.level.push_back(1.5 * std::abs(d->qfrc_bias[i]) + 2);
  return robot;
}

ModelPtr WithFriction(const Robot& robot, double timestep, mjtIntegrator integrator) {
  const SpecPtr spec(mj_copySpec(robot.spec.get()));
  spec->option.timestep = timestep;
  spec->option.integrator = integrator;
  const std::vector<std::string> joints = SpecNames(*spec, mjOBJ_JOINT);
  std::vector<FrictionForJoint> frictions;
  for (size_t i = 0; i < joints.size(); ++i) {
    FrictionDescription friction;
    friction.law = "coulomb";
    friction.parameters = {{"coulomb", robot.level[i]}};
    frictions.push_back({joints[i], friction});
  }
  AddFriction(*spec, frictions, {robot.path});
  return CompileModel(*spec, {robot.path});
}

constexpr double kQuiet = 0.2;    // s below 1e-9 rad/s until a robot counts as settled
constexpr double kPatience = 60;  // s

double Fastest(const mjModel* m, const mjData* d) {
  double fastest = 0;
  for (int i = 0; i < m->nv; ++i) fastest = std::max(fastest, std::abs(d->qvel[i]));
  return fastest;
}

struct Case {
  const char* file;
  double armature;  // kg.m^2, of every joint: what its lightest needs at 2 ms
};

class RobotsStick : public testing::TestWithParam<Case> {};

TEST_P(RobotsStick, WithEveryJointUnderGravityAtAnyStepAndIntegrator) {
  WARMJOINT_NEED_SHARED(std::string("robots/") + GetParam().file);
  const Robot robot = LoadRobot(GetParam().file, GetParam().armature);
  for (const double timestep : {0.0005, 0.001, 0.002}) {
    for (const mjtIntegrator integrator : {mjINT_EULER, mjINT_IMPLICITFAST, mjINT_DISCRETE}) {
      SCOPED_TRACE(
          fmt::format("timestep {} integrator {}", timestep, static_cast<int>(integrator)));
      const ModelPtr m = WithFriction(robot, timestep, integrator);
      const DataPtr d(mj_makeData(m.get()));
      std::copy(robot.pose.begin(), robot.pose.end(), d->qpos);

      // coupled modes without armature decay slowest, at 0.2 lambda / h
      double until = kQuiet;
      while (d->time < until && d->time < kPatience) {
        mj_step(m.get(), d.get());
        if (Fastest(m.get(), d.get()) > 1e-9) until = d->time + kQuiet;
      }
      ASSERT_LT(d->time, kPatience) << "never settled";

      const std::vector<double> settled(d->qpos, d->qpos + m->nq);
      for (int i = 0; i < std::lround(1 / timestep); ++i) mj_step(m.get(), d.get());
      for (int i = 0; i < m->nv; ++i) {
        EXPECT_LT(std::abs(d->qvel[i]), 1e-9) << "joint " << i;
        EXPECT_LT(std::abs(d->qpos[i] - settled[i]), 1e-6 / 60) << "joint " << i;
        EXPECT_LT(std::abs(d->qpos[i] - robot.pose[i]), 0.05) << "joint " << i;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, RobotsStick,
                         testing::Values(Case{"franka_emika_panda/panda_nohand_nomesh.xml", 0},
                                         Case{"kuka_iiwa_14/iiwa14_nomesh.xml", 0.001},
                                         Case{"universal_robots_ur5e/ur5e_nomesh.xml", 0.002},
                                         Case{"abb_irb140_drake/irb140_inertial_com_shifted.urdf",
                                              0.01},
                                         Case{"abb_yumi/yumi_nomesh.urdf", 0.007}),
                         [](const auto& test) {
                           const std::string file = test.param.file;
                           return file.substr(0, file.find('/'));
                         });

TEST(RobotsStick, AWristTooLightForItsFrictionIsRefusedWithTheArmatureThatItNeeds) {
  WARMJOINT_NEED_SHARED("robots/universal_robots_ur5e/ur5e_nomesh.xml");
  const Robot bare = LoadRobot("universal_robots_ur5e/ur5e_nomesh.xml", 0);
  // 2 N.m on 1.3e-4 kg.m^2 at 1 ms would give way by 0.15 rad; 0.05 rad need 4e-4 kg.m^2
  EXPECT_THAT([&] { WithFriction(bare, 0.001, mjINT_EULER); },
              ThrowsMessage<BadInput>(HasSubstr("actuator 'wrist_3_friction'")));
  EXPECT_THAT([&] { WithFriction(bare, 0.001, mjINT_EULER); },
              ThrowsMessage<BadInput>(HasSubstr("add an armature of 0.000271")));

  const Robot geared = LoadRobot("universal_robots_ur5e/ur5e_nomesh.xml", 0.000271);
  const ModelPtr m = WithFriction(geared, 0.001, mjINT_EULER);
  const DataPtr d(mj_makeData(m.get()));
  std::copy(geared.pose.begin(), geared.pose.end(), d->qpos);
  while (d->time < 5) mj_step(m.get(), d.get());
  EXPECT_LT(std::abs(d->qvel[5]), 1e-9);
}

}  // namespace
}  // namespace warmjoint
