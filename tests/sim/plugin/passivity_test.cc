// Friction takes energy and gives none: a minute of random torques, every law, step and integrator.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "models/foundation/random_stream.h"
#include "sim/plugin/bound_joints.h"
#include "tests/sim/plugin/two_forms.h"

namespace warmjoint {
namespace {

using namespace test;

/// The arm with sensors of its friction, at a step, s.
Model SensedArm(const Friction& friction, Form form, const std::string& integrator, double step) {
  std::string xml = SensedArmXml(friction, form);
  const std::string options = R"(timestep="0.001" integrator="implicitfast")";
  return MustCompile(
      xml.replace(xml.find(options), options.size(),
                  fmt::format(R"(timestep="{}" integrator="{}")", step, integrator)));
}

/// What friction has taken, J, over a run.
struct Taken {
  double least = 0;
  double end = 0;
};

Taken RunUnderRandomTorques(const mjModel* m, double seconds, std::uint64_t run) {
  RandomStream random({11, run}, Stream::test);
  const Data d(mj_makeData(m));
  Taken taken;
  double next = 0;
  while (d->time < seconds) {
    // a new torque each twentieth of a second, of a size that slides, sticks and breaks away
    if (d->time >= next) {
      for (int k = 0; k < kArmJoints; ++k) d->ctrl[k] = (4 - k) * random.Normal();
      next += 0.05;
    }
    double v[kArmJoints];
    std::copy_n(d->qvel, kArmJoints, v);
    mj_step(m, d.get());
    for (int k = 0; k < kArmJoints; ++k) {
      taken.end -= d->sensordata[kSensed * k] * v[k] * m->opt.timestep;
    }
    taken.least = std::min(taken.least, taken.end);
  }
  EXPECT_TRUE(std::isfinite(taken.end));
  return taken;
}

class PluginPassivity : public testing::TestWithParam<const char*> {};

TEST_P(PluginPassivity, TakesEnergyForAMinuteWithEveryLawStepAndForm) {
  std::uint64_t run = 0;
  for (const Friction& friction : FrictionsOfEveryLaw()) {
    for (const double step : {0.0005, 0.001, 0.002, 0.005}) {
      for (const Form form : {Form::actuator, Form::passive}) {
        const Model m = SensedArm(friction, form, GetParam(), step);
        const Taken taken = RunUnderRandomTorques(m.get(), 60, run++);
        EXPECT_GE(taken.least, 0) << friction.law << " step " << step;
        EXPECT_GT(taken.end, 1) << friction.law << " step " << step;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EveryIntegrator, PluginPassivity,
                         testing::Values("Euler", "implicit", "implicitfast", "discrete", "RK4"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace warmjoint
