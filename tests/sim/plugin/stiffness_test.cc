// How stiff joints hold and how soon they rest: a link, servos, and robots that people know.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "models/foundation/random_stream.h"
#include "sim/model/friction_actuator.h"
#include "sim/plugin/stability.h"
#include "tests/sim/plugin/friction_models.h"
#include "tests/sim/plugin/friction_robots.h"
#include "tests/sim/plugin/two_forms.h"
#include "tests/support/shared_data.h"

namespace warmjoint {
namespace {

/// How far a link of 0.005 kg.m^2 for each N.m of level has moved after a second under a load of
/// nine tenths of its level that sets in within a fifth of one, rad.
double Give(double step, const char* integrator) {
  const double level = 50;
  const test::Model m = test::MustCompile(test::LinkXml(
      test::FrictionSection({{"law", "coulomb"}, {"coulomb", "50"}}),
      fmt::format(R"(timestep="{}" integrator="{}" gravity="0 0 0")", step, integrator)));
  const test::Data d(mj_makeData(m.get()));
  while (d->time < 1) {
    d->qfrc_applied[0] = 0.9 * level * std::min(1.0, d->time / 0.2);
    mj_step(m.get(), d.get());
  }
  EXPECT_LT(std::abs(d->qvel[0]), 1e-9);
  return d->qpos[0];
}

TEST(PluginStiffness, GivesWayByWhatItsFormulaSaysAtNineTenthsOfTheLevel) {
  for (const char* integrator : {"Euler", "implicit", "implicitfast", "discrete", "RK4"}) {
    // 0.9 h^2 / (0.64 0.005): 1.1 mrad at 2 ms
    for (const double step : {0.0005, 0.001, 0.002, 0.005}) {
      EXPECT_NEAR(Give(step, integrator), 281.25 * step * step, 1e-9);
    }
  }
}

double Fastest(const mjModel* m, const mjData* d) {
  double fastest = 0;
  for (int i = 0; i < m->nv; ++i) fastest = std::max(fastest, std::abs(d->qvel[i]));
  return fastest;
}

/// The greatest speed in the last tenth of two seconds after a release from a pose, rad/s.
double SpeedLeft(const mjModel* m, const std::vector<double>& pose) {
  const test::Data d(mj_makeData(m));
  std::copy(pose.begin(), pose.end(), d->qpos);
  double fastest = 0;
  while (d->time < 2) {
    mj_step(m, d.get());
    if (d->time > 1.8) fastest = std::max(fastest, Fastest(m, d.get()));
  }
  return fastest;
}

/// A hinge of 0.001 kg.m^2 at 2 ms whose servo adds K = kp h^2/M and C = kv h/M to a step, with friction
/// of a twentieth of what the servo gives at 0.1 rad.
test::Model Servo(double k, double c, const char* integrator) {
  const double stiffness = k * 0.001 / 4e-6, damping = c * 0.001 / 0.002;
  const std::string level = fmt::format("{}", 0.005 * stiffness);
  std::string sections = test::FrictionSection({{"law", "coulomb"}, {"coulomb", level}});
  sections.insert(sections.find("<plugin"),
                  fmt::format(R"(<general joint="hinge" gainprm="{0}" biastype="affine"
                                   biasprm="0 -{0} -{1}"/>)",
                              stiffness, damping));
  return test::MustCompile(test::OneBodyXml(
      R"(<joint name="hinge" axis="0 0 1"/>
         <inertial pos="0 0 0" mass="1" diaginertia="0.001 0.001 0.001"/>)",
      sections, fmt::format(R"(timestep="0.002" integrator="{}" gravity="0 0 0")", integrator)));
}

TEST(PluginStiffness, RestsBesideServosAsStiffAsFrictionlossBears) {
  for (const char* integrator : {"Euler", "implicit", "implicitfast", "discrete", "RK4"}) {
    for (const double k : {1.0, 1.5, 1.6, 1.7, 2.0, 2.3, 2.6, 3.0}) {
      const test::Model m = Servo(k, 0, integrator);
      for (const double from : {0.1, 0.077, 0.03}) {
        EXPECT_LT(SpeedLeft(m.get(), {from}), 1e-6) << integrator << ", K " << k;
      }
    }
  }
  // explicit damping counts twice, and damping that the integrator takes implicitly carries stiffness
  EXPECT_LT(SpeedLeft(Servo(0.31, 1.1, "Euler").get(), {0.1}), 1e-6);
  EXPECT_LT(SpeedLeft(Servo(2, 0.5, "Euler").get(), {0.1}), 1e-6);
  EXPECT_LT(SpeedLeft(Servo(4, 0.5, "implicitfast").get(), {0.1}), 1e-6);
}

/// A finger of three hinges under servos of that stiffness, N.m/rad, at 2 ms.
test::Model Finger(double stiffness, FrictionForm form) {
  const SpecPtr spec = test::ParseXml(fmt::format(
      R"(<mujoco><option timestep="0.002"/><default><joint axis="0 1 0" armature="2e-4"/>
        <geom type="capsule" fromto="0 0 0 0.05 0 0" size="0.01" mass="0.04"/>
        <position kp="{}"/></default><worldbody><body>
        <joint name="a" axis="0 0 1"/><geom/><body pos="0.05 0 0"><joint name="b"/><geom/>
        <body pos="0.05 0 0"><joint name="c"/><geom/></body></body></body></worldbody>
        <actuator><position joint="a"/><position joint="b"/><position joint="c"/></actuator></mujoco>)",
      stiffness));
  const Friction friction{"coulomb", {{"coulomb", 0.005 * stiffness}}, {}};
  AddFriction(*spec, {{"a", friction}, {"b", friction}, {"c", friction}}, {"finger"},
              {.form = form});
  return CompileModel(*spec, {"finger"});
}

TEST(PluginStiffness, RestsBesideServosOfCoupledJoints) {
  RandomStream random({11, 0}, Stream::test);
  for (const FrictionForm form : {FrictionForm::actuator, FrictionForm::passive}) {
    // K of the stiffest mode 1.9, 2.3 and 2.7
    for (const double stiffness : {100, 120, 140}) {
      const test::Model m = Finger(stiffness, form);
      for (int run = 0; run < 5; ++run) {
        std::vector<double> pose(3);
        for (double& q : pose) q = random.Uniform(-0.3, 0.3);
        EXPECT_LT(SpeedLeft(m.get(), pose), 1e-6) << stiffness;
      }
    }
  }
}

TEST(PluginStiffness, WarnsOfServosThatLeaveBristlesNothing) {
  const test::Model m = Servo(5, 0, "Euler");
  const test::Data d(mj_makeData(m.get()));
  const test::Warnings warnings;
  mj_step(m.get(), d.get());
  const std::string once = test::Warnings::text();
  EXPECT_THAT(once, testing::HasSubstr("--timestep"));
  mj_step(m.get(), d.get());
  EXPECT_EQ(test::Warnings::text(), once);
}

/// A robot with these levels of friction, [nv] N.m or N, on its joints.
ModelPtr WithFriction(const test::Robot& robot, double step, mjtIntegrator integrator,
                      const std::vector<double>& levels, FrictionForm form) {
  const SpecPtr spec(mj_copySpec(robot.spec.get()));
  spec->option.timestep = step;
  spec->option.integrator = integrator;
  std::vector<FrictionForJoint> frictions;
  for (const std::string& joint : SpecNames(*spec, mjOBJ_JOINT)) {
    frictions.push_back({joint, {"coulomb", {{"coulomb", levels[frictions.size()]}}, {}}});
  }
  AddFriction(*spec, frictions, {robot.path}, {.form = form});
  return CompileModel(*spec, {robot.path});
}

/// The same with levels that let bristles give way by 20 mrad (2 mm), without gravity.
ModelPtr Holding(const test::Robot& robot, double step, mjtIntegrator integrator,
                 FrictionForm form) {
  const ModelPtr bare = CompileModel(*robot.spec, {robot.path});
  std::vector<double> levels;
  for (int i = 0; i < bare->njnt; ++i) {
    const double give = bare->jnt_type[i] == mjJNT_SLIDE ? 0.002 : 0.02;
    levels.push_back(give * kLoneBristles.stiffness *
                     EffectiveInertia(bare.get(), bare->jnt_dofadr[i]) / (step * step));
  }
  ModelPtr m = WithFriction(robot, step, integrator, levels, form);
  mju_zero3(m->opt.gravity);
  return m;
}

void DrawPose(const mjModel* m, mjData* d, RandomStream& random) {
  for (int i = 0; i < m->njnt; ++i) {
    const bool limited = m->jnt_limited[i];
    d->qpos[i] =
        random.Uniform(limited ? m->jnt_range[2 * i] : -3, limited ? m->jnt_range[2 * i + 1] : 3);
  }
}

/// The largest eigenvalue of what a step does to speeds and bristles of a robot at rest.
double SpectralRadius(const mjModel* m, mjData* d) {
  const auto n = static_cast<int>(m->nv);
  const std::vector<mjtNum> pose(d->qpos, d->qpos + m->nq);
  const double size = 1e-7;
  const auto after = [&](int k) {
    std::copy(pose.begin(), pose.end(), d->qpos);
    std::fill_n(d->qvel, n, 0.0);
    std::fill_n(test::StatesOf(m, d), 2 * n, 0.0);
    std::fill_n(d->qacc_warmstart, n, 0.0);
    if (k >= 0) (k < n ? d->qvel[k] : test::StatesOf(m, d)[2 * (k - n)]) = size;
    mj_step(m, d);
    Eigen::VectorXd state(2 * n);
    for (int i = 0; i < n; ++i) {
      state[i] = d->qvel[i];
      state[n + i] = test::StatesOf(m, d)[2 * i];
    }
    return state;
  };
  const Eigen::VectorXd rest = after(-1);
  Eigen::MatrixXd map(2 * n, 2 * n);
  for (int k = 0; k < 2 * n; ++k) map.col(k) = (after(k) - rest) / size;
  std::copy(pose.begin(), pose.end(), d->qpos);
  return map.eigenvalues().cwiseAbs().maxCoeff();
}

class ArmsWithoutArmature : public testing::TestWithParam<test::RobotCase> {};

TEST_P(ArmsWithoutArmature, AreStableInEveryPose) {
  WARMJOINT_NEED_SHARED(std::string("robots/") + GetParam().file);
  const test::Robot robot = test::LoadRobot(GetParam().file, 0);
  for (const mjtIntegrator integrator : {mjINT_EULER, mjINT_IMPLICITFAST, mjINT_RK4}) {
    for (const double step : {0.001, 0.005}) {
      const FrictionForm form =
          integrator == mjINT_EULER ? FrictionForm::actuator : FrictionForm::passive;
      const ModelPtr m = Holding(robot, step, integrator, form);
      const DataPtr d(mj_makeData(m.get()));
      RandomStream random({9, 0}, Stream::test);
      double worst = 0;
      for (int pose = 0; pose < 50; ++pose) {
        DrawPose(m.get(), d.get(), random);
        worst = std::max(worst, SpectralRadius(m.get(), d.get()));
      }
      // each mode: (z - 0.2)^2, and less damped where the arm's own damping adds to it; of RK4 0.59
      EXPECT_LT(worst, 0.6) << "step " << step;
    }
  }
}

TEST_P(ArmsWithoutArmature, RestWithin25StepsOfAPush) {
  WARMJOINT_NEED_SHARED(std::string("robots/") + GetParam().file);
  const test::Robot robot = test::LoadRobot(GetParam().file, 0);
  for (const mjtIntegrator integrator : {mjINT_EULER, mjINT_IMPLICITFAST}) {
    for (const double step : {0.0005, 0.001, 0.002}) {
      for (const FrictionForm form : {FrictionForm::actuator, FrictionForm::passive}) {
        const ModelPtr m = Holding(robot, step, integrator, form);
        const DataPtr d(mj_makeData(m.get()));
        RandomStream random({10, 0}, Stream::test);
        for (int run = 0; run < 10; ++run) {
          mj_resetData(m.get(), d.get());
          DrawPose(m.get(), d.get(), random);
          // a tenth of a milliradian of each bristle, held, then released
          for (int i = 0; i < m->nv; ++i) {
            const double inertia = EffectiveInertia(m.get(), i);
            d->qfrc_applied[i] = random.Uniform(-1, 1) * 1e-4 * inertia / (step * step);
          }
          for (int i = 0; i < 100; ++i) mj_step(m.get(), d.get());
          std::fill_n(d->qfrc_applied, m->nv, 0.0);
          for (int i = 0; i < 25; ++i) mj_step(m.get(), d.get());
          EXPECT_LT(Fastest(m.get(), d.get()), 1e-4);
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, ArmsWithoutArmature, testing::ValuesIn(test::kRobots),
                         [](const auto& test) { return test.param.name(); });

constexpr double kQuiet = 0.2;   // s below 1e-9 rad/s until a robot counts as settled
constexpr double kLongest = 60;  // s

class RobotsStick : public testing::TestWithParam<test::RobotCase> {};

TEST_P(RobotsStick, WithEveryJointUnderGravityAtAnyStepAndIntegrator) {
  WARMJOINT_NEED_SHARED(std::string("robots/") + GetParam().file);
  const test::Robot robot = test::LoadRobot(GetParam().file, GetParam().armature);
  for (const double timestep : {0.0005, 0.001, 0.002}) {
    for (const mjtIntegrator integrator : {mjINT_EULER, mjINT_IMPLICITFAST, mjINT_DISCRETE}) {
      SCOPED_TRACE(
          fmt::format("timestep {} integrator {}", timestep, static_cast<int>(integrator)));
      const ModelPtr m =
          WithFriction(robot, timestep, integrator, robot.level, FrictionForm::actuator);
      const DataPtr d(mj_makeData(m.get()));
      std::copy(robot.pose.begin(), robot.pose.end(), d->qpos);

      // coupled modes without armature decay slowest, at 0.2 lambda / h
      double until = kQuiet;
      while (d->time < until && d->time < kLongest) {
        mj_step(m.get(), d.get());
        if (Fastest(m.get(), d.get()) > 1e-9) until = d->time + kQuiet;
      }
      ASSERT_LT(d->time, kLongest) << "never settled";

      const std::vector<double> settled(d->qpos, d->qpos + m->nq);
      for (int i = 0; i < std::lround(1 / timestep); ++i) mj_step(m.get(), d.get());
      EXPECT_LT(Fastest(m.get(), d.get()), 1e-9);
      for (int i = 0; i < m->nv; ++i) {
        EXPECT_LT(std::abs(d->qpos[i] - settled[i]), 1e-6 / 60) << "joint " << i;
        EXPECT_LT(std::abs(d->qpos[i] - robot.pose[i]), 0.05) << "joint " << i;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, RobotsStick, testing::ValuesIn(test::kRobots),
                         [](const auto& test) { return test.param.name(); });

}  // namespace
}  // namespace warmjoint
