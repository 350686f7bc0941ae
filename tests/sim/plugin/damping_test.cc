// Friction's viscous as the joint's damping, which MuJoCo adds, and what else the step has to bear beside it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/attach.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "sim/model/friction_actuator.h"
#include "sim/model/load_model.h"
#include "tests/sim/plugin/friction_models.h"

namespace warmjoint {
namespace {

using testing::HasSubstr;

constexpr double kHingeInertia = 0.001, kHingeStep = 0.002;  // kg.m^2, s

/// A hinge under a servo of K = kp h^2/M.
std::string HingeXml(double k, const char* integrator, const char* flags = "") {
  return fmt::format(R"(<mujoco>
    <option timestep="{}" integrator="{}" gravity="0 0 0"><flag contact="disable" {}/></option>
    <worldbody><body name="link"><joint name="hinge" axis="0 0 1"/>
      <inertial pos="0 0 0" mass="1" diaginertia="{} {} {}"/></body></worldbody>
    <actuator><position joint="hinge" kp="{}"/></actuator></mujoco>)",
                     kHingeStep, integrator, flags, kHingeInertia, kHingeInertia, kHingeInertia,
                     k * kHingeInertia / (kHingeStep * kHingeStep));
}

Friction Braked(double viscous, double level) {
  return {"viscous_coulomb", {{"viscous", viscous}, {"coulomb", level}}, Thermal{-0.1, 5}};
}

struct AttachedHinge {
  ModelPtr model;
  std::vector<std::string> notices;
};

AttachedHinge Attaching(const std::string& xml, const std::vector<FrictionForJoint>& frictions,
                        const AttachOptions& options = {}) {
  const SpecPtr spec = test::ParseXml(xml);
  AttachedHinge result;
  result.notices = AttachFriction(*spec, frictions, options, "robot").notices;
  result.model = CompileModel(*spec, {"robot"});
  return result;
}

std::string Joined(const std::vector<std::string>& lines) {
  return std::accumulate(lines.begin(), lines.end(), std::string());
}

TEST(PluginDamping, LetsAJointRestBesideAnyServoHoweverViscous) {
  for (const char* integrator : {"Euler", "implicitfast", "implicit", "discrete"}) {
    for (const double k : {0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 2.75, 3.0}) {
      for (const double share : {0.0, 0.1, 0.3, 0.49, 1.0, 5.0, 50.0}) {
        const double kp = k * kHingeInertia / (kHingeStep * kHingeStep), from = 0.1;
        const double level = 0.05 * std::max(kp, 1.0) * from;
        const AttachedHinge result =
            Attaching(HingeXml(k, integrator),
                      {{"hinge", Braked(share * kHingeInertia / kHingeStep, level)}});
        const mjModel* m = result.model.get();
        const DataPtr d(mj_makeData(m));
        d->qpos[0] = from;
        double left = 0;
        while (d->time < 6) {
          mj_step(m, d.get());
          if (d->time > 5.5) left = std::max(left, std::abs(d->qvel[0]));
        }
        EXPECT_LT(left, 1e-6) << integrator << " K " << k << " viscous " << share;
      }
    }
  }
}

TEST(PluginDamping, CountsInTorqueLossAndHeat) {
  // a plugin that adds its viscous itself feels the same
  for (const FrictionForm form : {FrictionForm::actuator, FrictionForm::passive}) {
    const AttachOptions options{.form = form, .sensors = true};
    const Friction friction = Braked(0.03, 0.1);
    const AttachedHinge result = Attaching(HingeXml(0, "Euler"), {{"hinge", friction}}, options);
    const SpecPtr spec = test::ParseXml(HingeXml(0, "Euler"));
    AddFriction(*spec, {{"hinge", friction}}, {"robot"}, options);
    const ModelPtr by_plugin = CompileModel(*spec, {"robot"});
    EXPECT_EQ(result.model->dof_damping[0], 0.03);
    EXPECT_EQ(by_plugin->dof_damping[0], 0);

    const DataPtr d(mj_makeData(result.model.get())), e(mj_makeData(by_plugin.get()));
    for (int i = 0; i < 1000; ++i) {
      d->qvel[0] = e->qvel[0] = 2;
      mj_step(result.model.get(), d.get());
      mj_step(by_plugin.get(), e.get());
      for (int k = 0; k < 5; ++k) ASSERT_NEAR(d->sensordata[k], e->sensordata[k], 1e-15);
    }
    EXPECT_LT(d->sensordata[1], -0.01) << "warm";

    // what acts is the same as well
    d->qvel[0] = e->qvel[0] = 2;
    mj_forward(result.model.get(), d.get());
    mj_forward(by_plugin.get(), e.get());
    EXPECT_NEAR(d->qacc[0], e->qacc[0], 1e-9);
  }
}

TEST(PluginDamping, IsReadAtEachStep) {
  const AttachedHinge result =
      Attaching(HingeXml(0, "implicitfast"), {{"hinge", Braked(0.03, 0.1)}},
                {.form = FrictionForm::passive, .sensors = true});
  mjModel* m = result.model.get();
  const DataPtr d(mj_makeData(m));
  for (const double damping : {0.03, 0.05, 0.0}) {
    m->dof_damping[0] = damping;
    d->qvel[0] = 2;
    mj_step(m, d.get());
    d->qvel[0] = 2;
    mj_step(m, d.get());
    // and the level, which the heat has lowered by a little
    EXPECT_NEAR(-d->sensordata[0], 2 * damping + 0.1, 1e-3) << damping;
    EXPECT_NEAR(d->sensordata[3], -2 * d->sensordata[0], 1e-12);
  }
}

TEST(PluginDamping, ThatTheEngineTakesExplicitlyOrLeavesOutIsWarnedOf) {
  const struct {
    const char *integrator, *flags, *words;
  } cases[] = {{"RK4", "", "armature"},
               {"Euler", R"(eulerdamp="disable")", "armature"},
               {"Euler", R"(damper="disable")", "flag damper is disabled"},
               {"implicitfast", "", ""}};
  for (const auto& [integrator, flags, words] : cases) {
    const AttachedHinge result = Attaching(
        HingeXml(0, integrator, flags), {{"hinge", Braked(0.7 * kHingeInertia / kHingeStep, 0.1)}});
    const bool quiet = words[0] == '\0';
    EXPECT_EQ(Joined(result.notices).find("damp") == std::string::npos, quiet) << integrator;
    EXPECT_THAT(Joined(result.notices), HasSubstr(words));
    const DataPtr d(mj_makeData(result.model.get()));
    const test::Warnings warnings;
    mj_step(result.model.get(), d.get());
    EXPECT_EQ(test::Warnings::text().empty(), quiet) << integrator;
    EXPECT_THAT(test::Warnings::text(), HasSubstr(words));
  }
}

constexpr char kDoubleLink[] = R"(<mujoco>
  <option timestep="0.002"/>
  <worldbody><body><joint name="a" axis="0 1 0" damping="1"/>
    <geom type="capsule" fromto="0 0 0 .3 0 0" size=".04"/>
    <body pos=".3 0 0"><joint name="b" axis="0 1 0" frictionloss="1"/>
      <geom type="capsule" fromto="0 0 0 .3 0 0" size=".04"/></body></body></worldbody>
  <sensor><jointpos joint="a"/></sensor></mujoco>)";

TEST(PluginDamping, ASecondAttachGivesTheModelOfOne) {
  const FrictionForJoint a{"a", Braked(0.2, 1), {-0.1}}, b{"b", Braked(0.1, 2)};
  for (const FrictionForm form : {FrictionForm::actuator, FrictionForm::passive}) {
    for (const bool more : {false, true}) {
      const AttachOptions options{.form = form, .sensors = more, .numbers = more};
      const SpecPtr once = test::ParseXml(kDoubleLink);
      AttachFriction(*once, {a, b}, options, "robot");
      const std::string text = ModelToXml(*once, {"robot"});
      const SpecPtr twice = test::ParseXml(kDoubleLink);
      AttachFriction(*twice, {a}, options, "robot");
      const Attached second = AttachFriction(*twice, {b}, options, "robot");
      EXPECT_THAT(second.joints, testing::ElementsAre("b"));
      EXPECT_EQ(ModelToXml(*twice, {"robot"}), text);

      // also onto what was written and read
      const SpecPtr first = test::ParseXml(kDoubleLink);
      AttachFriction(*first, {a}, options, "robot");
      const SpecPtr read = test::ParseXml(ModelToXml(*first, {"robot"}));
      AttachFriction(*read, {b}, options, "robot");
      EXPECT_EQ(ModelToXml(*read, {"robot"}), text);
    }
  }
}

TEST(PluginDamping, AServoOfAProgramsOwnRestsWithTheStiffestDriveThatIsGiven) {
  for (const double k : {1.0, 1.3, 2.0, 2.5, 3.0}) {
    AttachOptions options;
    if (k > 1.3) options.stiffest_drive = k;
    const AttachedHinge result = Attaching(
        HingeXml(0, "Euler"),
        {{"hinge", Braked(0, 0.005 * k * kHingeInertia / (kHingeStep * kHingeStep))}}, options);
    const mjModel* m = result.model.get();
    const DataPtr d(mj_makeData(m));
    d->qpos[0] = 0.1;
    double left = 0;
    while (d->time < 3) {
      d->qfrc_applied[0] = -k * kHingeInertia / (kHingeStep * kHingeStep) * d->qpos[0];
      mj_step(m, d.get());
      if (d->time > 2.5) left = std::max(left, std::abs(d->qvel[0]));
    }
    EXPECT_LT(left, 1e-6) << k;
  }
}

TEST(PluginDamping, AnArmatureTakenAwayInARunIsWarnedOf) {
  std::string xml = HingeXml(2, "Euler");
  xml.replace(xml.find("axis="), 5, R"(armature="0.004" axis=)");
  const AttachedHinge result = Attaching(xml, {{"hinge", Braked(0.01, 0.1)}});
  mjModel* m = result.model.get();
  const DataPtr d(mj_makeData(m));
  const test::Warnings warnings;
  mj_step(m, d.get());
  EXPECT_EQ(test::Warnings::text(), "");
  // K is 2 of the link alone
  m->actuator_biasprm[1] *= 2, m->actuator_gainprm[0] *= 2;
  m->dof_armature[0] = 0;
  mj_setConst(m, d.get());
  mj_step(m, d.get());
  EXPECT_THAT(test::Warnings::text(), HasSubstr("servos are too stiff"));
}

}  // namespace
}  // namespace warmjoint
