// Joints that stick under torques that jump, as policies and sampled controllers give them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "models/foundation/random_stream.h"
#include "sim/model/friction_actuator.h"
#include "sim/plugin/stability.h"
#include "tests/sim/plugin/friction_models.h"
#include "tests/sim/plugin/friction_robots.h"
#include "tests/support/shared_data.h"

namespace warmjoint {
namespace {

constexpr double kHeld = 0.02;  // s, a torque

/// A hinge without weight, kg.m^2, at a step, s.
test::Model Hinge(double inertia, const test::Config& friction, int states, double step) {
  return test::MustCompile(test::OneBodyXml(fmt::format(R"(<joint name="hinge" axis="0 0 1"/>
                     <inertial pos="0 0 0" mass="1" diaginertia="{0} {0} {0}"/>)",
                                                        inertia),
                                            test::FrictionSection(friction, {.states = states}),
                                            fmt::format(R"(timestep="{}" gravity="0 0 0")", step)));
}

TEST(PluginJumps, BelowTheLevelMoveNothing) {
  const struct { double inertia, level; } hinges[] = {{0.174, 6}, {0.032, 3}};
  const double torques[][2] = {{0.95, -0.2}, {0.9, 0}, {0.8, 0}, {0.95, 0.5}, {0.6, 0}};
  for (const auto& [inertia, level] : hinges) {
    for (const double step : {0.001, 0.002}) {
      const test::Model m =
          Hinge(inertia, {{"law", "coulomb"}, {"coulomb", fmt::format("{}", level)}}, 2, step);
      const double give = level * step * step / (kLoneBristles.stiffness * inertia);
      const long period = std::lround(2 * kHeld / step), half = period / 2;
      for (const auto& torque : torques) {
        const test::Data d(mj_makeData(m.get()));
        double settled = 0, farthest = 0;
        for (long i = 0; i < std::lround(60 / step); ++i) {
          d->qfrc_applied[0] = level * torque[i % period / half];
          mj_step(m.get(), d.get());
          farthest = std::max(farthest, std::abs(d->qpos[0]));
          if (i + 1 == std::lround(2 / kHeld / 2) * period) settled = d->qpos[0];
        }
        EXPECT_LT(std::abs(d->qpos[0] - settled), 1e-6)
            << inertia << " " << step << " " << torque[0];
        EXPECT_LT(farthest, 1.05 * give) << inertia << " " << step << " " << torque[0];
      }
    }
  }
}

TEST(PluginJumps, BelowItsLevelAtRestHoldStictionAtAnyStep) {
  for (const double rise : {1.3, 1.5}) {
    for (const double inertia : {1.0, 0.05}) {
      for (const double step : {0.0005, 0.001, 0.002, 0.005}) {
        // as much as the give of the largest step bears
        const double coulomb = 4 * std::min(1.0, inertia);
        const test::Model m = Hinge(inertia,
                                    {{"law", "stiction"},
                                     {"viscous", "0"},
                                     {"coulomb", fmt::format("{}", coulomb)},
                                     {"static", fmt::format("{}", rise * coulomb)}},
                                    3, step);
        for (const double share : {0.98, 1.02}) {
          const test::Data d(mj_makeData(m.get()));
          d->qfrc_applied[0] = share * rise * coulomb;
          while (d->time < 1) mj_step(m.get(), d.get());
          const bool stays = std::abs(d->qvel[0]) < 1e-9;
          EXPECT_EQ(stays, share < 1) << rise << " " << inertia << " " << step << " " << share;
        }
      }
    }
  }
}

TEST(PluginJumps, OnAllJointsOfAnArmMoveNothing) {
  const char* file = "universal_robots_ur5e/ur5e_nomesh.xml";
  WARMJOINT_NEED_SHARED(std::string("robots/") + file);
  const double levels[] = {10, 10, 8, 4, 4, 4};  // N.m
  for (const double armature : {0.01, 0.1}) {
    const test::Robot robot = test::LoadRobot(file, armature);
    std::vector<FrictionForJoint> frictions;
    for (const std::string& joint : SpecNames(*robot.spec, mjOBJ_JOINT)) {
      frictions.push_back({joint, {"coulomb", {{"coulomb", levels[frictions.size()]}}, {}}});
    }
    robot.spec->option.timestep = 0.002;
    std::fill_n(robot.spec->option.gravity, 3, 0.0);
    AddFriction(*robot.spec, frictions, {robot.path}, {.form = FrictionForm::passive});
    const ModelPtr m = CompileModel(*robot.spec, {robot.path});
    for (const auto& [bias, swing] : {std::pair(0.4, 0.5), std::pair(0.0, 0.9)}) {
      const DataPtr d(mj_makeData(m.get()));
      std::copy(robot.pose.begin(), robot.pose.end(), d->qpos);
      RandomStream random({21, 0}, Stream::test);
      // the farthest of the first second, and of the next seven
      double first = 0, after = 0;
      for (int k = 0; k < 400; ++k) {
        for (int i = 0; i < 6; ++i) {
          d->qfrc_applied[i] = levels[i] * (bias + swing * random.Uniform(-1, 1));
        }
        for (int i = 0; i < 10; ++i) mj_step(m.get(), d.get());
        double& farthest = k < 50 ? first : after;
        for (int i = 0; i < 6; ++i) {
          farthest = std::max(farthest, std::abs(d->qpos[i] - robot.pose[i]));
        }
      }
      // the bristles' give alone, of which other torques ask a little more
      EXPECT_LT(after, 1.2 * first) << armature << " " << bias;
    }
  }
}

}  // namespace
}  // namespace warmjoint
