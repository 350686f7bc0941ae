// Friction on every joint of robots that people know.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "models/foundation/bad_input.h"
#include "sim/model/friction_actuator.h"
#include "tests/sim/plugin/friction_robots.h"
#include "tests/support/shared_data.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

ModelPtr WithFriction(const test::Robot& robot, double timestep, mjtIntegrator integrator) {
  const SpecPtr spec(mj_copySpec(robot.spec.get()));
  spec->option.timestep = timestep;
  spec->option.integrator = integrator;
  const std::vector<std::string> joints = SpecNames(*spec, mjOBJ_JOINT);
  std::vector<FrictionForJoint> frictions;
  for (size_t i = 0; i < joints.size(); ++i) {
    Friction friction;
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

class RobotsStick : public testing::TestWithParam<test::RobotCase> {};

TEST_P(RobotsStick, WithEveryJointUnderGravityAtAnyStepAndIntegrator) {
  WARMJOINT_NEED_SHARED(std::string("robots/") + GetParam().file);
  const test::Robot robot = test::LoadRobot(GetParam().file, GetParam().armature);
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

INSTANTIATE_TEST_SUITE_P(All, RobotsStick, testing::ValuesIn(test::kRobots),
                         [](const auto& test) { return test.param.name(); });

TEST(RobotsStick, AWristTooLightForItsFrictionIsRefusedWithTheArmatureThatItNeeds) {
  WARMJOINT_NEED_SHARED("robots/universal_robots_ur5e/ur5e_nomesh.xml");
  const test::Robot bare = test::LoadRobot("universal_robots_ur5e/ur5e_nomesh.xml", 0);
  // 2 N.m on 1.3e-4 kg.m^2 at 2 ms would give way by 0.075 rad; 0.05 rad need 2e-4 kg.m^2
  EXPECT_THAT([&] { WithFriction(bare, 0.002, mjINT_EULER); },
              ThrowsMessage<BadInput>(HasSubstr("actuator 'wrist_3_friction'")));
  EXPECT_THAT([&] { WithFriction(bare, 0.002, mjINT_EULER); },
              ThrowsMessage<BadInput>(HasSubstr("add an armature of 6.95e-05")));

  const test::Robot geared = test::LoadRobot("universal_robots_ur5e/ur5e_nomesh.xml", 6.95e-05);
  const ModelPtr m = WithFriction(geared, 0.002, mjINT_EULER);
  const DataPtr d(mj_makeData(m.get()));
  std::copy(geared.pose.begin(), geared.pose.end(), d->qpos);
  while (d->time < 5) mj_step(m.get(), d.get());
  EXPECT_LT(std::abs(d->qvel[5]), 1e-9);
}

}  // namespace
}  // namespace warmjoint
