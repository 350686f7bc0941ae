// The forward model and the plugin's kernel against recordings that the project did not make.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/golden.h"

namespace warmjoint {
namespace {

using Eigen::Index;

double Largest(const Eigen::VectorXd& x) { return x.cwiseAbs().maxCoeff(); }

TEST(GoldenMotion, EveryLawHasOne) {
  for (const Law& law : Laws()) {
    EXPECT_EQ(test::ReadGoldenMotion(std::string(law.name)).friction.law, law.name);
  }
}

TEST(GoldenMotion, IsWhatTheForwardModelGivesForLawsThatSlideSteadily) {
  for (const char* name : {"coulomb", "viscous_coulomb", "asymmetric", "stiction", "stribeck",
                           "asymmetric_stribeck", "everything"}) {
    const test::GoldenMotion golden = test::ReadGoldenMotion(name);
    const Prediction p =
        AlongMotion(golden.friction).Predict(golden.trajectory, {golden.initial_energy});
    // both follow the same equations: rounding of 600 steps at 20 N.m; kernels to 1e-12
    EXPECT_LT(Largest(p.force - golden.force), 2e-12) << name;
    EXPECT_LT(Largest(p.energy - golden.energy), 2e-12) << name;
  }
}

/// Largest error of the forward model where it sees every so manieth sample, N.m.
double ErrorOfEvery(const test::GoldenMotion& golden, Index every) {
  const Index n = (golden.force.size() + every - 1) / every;
  const auto taken = Eigen::seqN(0, n, every);
  JointTrajectory trajectory{golden.trajectory.time(taken), golden.trajectory.velocity(taken)};
  const Prediction p = AlongMotion(golden.friction).Predict(trajectory);
  return Largest(p.force - Eigen::VectorXd(golden.force(taken)));
}

TEST(GoldenMotion, IsWhatTheForwardModelTendsToForLawsWithABristle) {
  for (const char* name : {"dahl", "lugre", "asymmetric_lugre"}) {
    const test::GoldenMotion golden = test::ReadGoldenMotion(name);
    // (22) holds W over each step, so that E trails by half of it: to first order
    const double most_heat = Largest((golden.energy.tail(2000) - golden.energy.head(2000))) / 0.01;
    const double error = ErrorOfEvery(golden, 1);
    // once by that, once more by what the lag does to F; the bristle itself errs to second order
    EXPECT_LT(error, 2 * 0.005 * most_heat) << name;
    EXPECT_NEAR(ErrorOfEvery(golden, 2) / error, 2, 0.5) << name;
    EXPECT_LT(error, 0.002 * Largest(golden.force)) << name;

    // the bristle is bent from rest
    const Prediction p = AlongMotion(golden.friction).Predict(golden.trajectory);
    EXPECT_EQ(p.bristle[0], 0) << name;
    EXPECT_LT(Largest(p.bristle - golden.bristle), 0.002 * Largest(golden.bristle)) << name;
  }
}

TEST(GoldenMotion, IsWhatThePluginsKernelStepsTo) {
  // the recorded velocity, linear between samples, in steps of 0.1 ms
  constexpr Index kParts = 100;
  const double h = 1e-4;
  for (const char* name : {"dahl", "lugre", "asymmetric_lugre"}) {
    const test::GoldenMotion golden = test::ReadGoldenMotion(name);
    JointFriction joint(golden.friction);
    joint.SetTimestep(h);
    FrictionState state;
    double worst = 0, worst_energy = 0;
    const Eigen::VectorXd& v = golden.trajectory.velocity;
    for (Index i = 0; i + 1 < v.size(); ++i) {
      worst_energy = std::max(worst_energy, std::abs(state.energy - golden.energy[i]));
      for (Index k = 0; k < kParts; ++k) {
        const double share = (static_cast<double>(k) + 0.5) / kParts;
        // an inertia so large that the bristle is the law's own
        const FrictionStep step =
            joint.Step(state, {.velocity = v[i] + share * (v[i + 1] - v[i]), .inertia = 1e6});
        if (k == 0) worst = std::max(worst, std::abs(step.force - golden.force[i]));
        state = step.next;
      }
    }
    // the force is that of the end of a step: sigma0 |v| h behind, and as much by the heat
    EXPECT_LT(worst, 500 * 0.4 * h) << name;
    EXPECT_LT(worst_energy, 1e-3 * Largest(golden.energy)) << name;
  }
}

TEST(GoldenMotion, IsWhatThePluginsKernelSlidesAt) {
  // steps of the samples' length and a bristle that yields at once
  for (const char* name : {"coulomb", "viscous_coulomb", "asymmetric", "stribeck",
                           "asymmetric_stribeck", "everything"}) {
    const test::GoldenMotion golden = test::ReadGoldenMotion(name);
    JointFriction joint(golden.friction);
    joint.SetTimestep(golden.trajectory.step);
    FrictionState state{0, golden.initial_energy};
    const JointTrajectory& trajectory = golden.trajectory;
    const auto at = [](const Eigen::VectorXd& column, Index i) {
      return column.size() > 0 ? column[i] : 0;
    };
    for (Index i = 0; i < golden.force.size(); ++i) {
      const double v = trajectory.velocity[i];
      if (v == 0) state.bristle = 0;
      const FrictionStep step =
          joint.Step(state, {at(trajectory.position, i), v, 1e6, at(trajectory.load, i),
                             at(trajectory.ambient_rise, i)});
      ASSERT_NEAR(step.force, golden.force[i], 2e-12) << name << " at " << i;
      ASSERT_NEAR(state.energy + state.second_energy, golden.energy[i], 2e-12) << name << i;
      state = step.next;
    }
  }
}

}  // namespace
}  // namespace warmjoint
