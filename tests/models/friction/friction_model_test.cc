#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/errors.h>
#include <warmjoint/friction_model.h>

#include <cmath>

namespace warmjoint {
namespace {

/// Table I of the paper.
Friction TableOne() {
  return {"viscous_coulomb", {{"viscous", 5}, {"coulomb", 15}}, Thermal{-3, 600}};
}

TEST(FrictionModel, GivesTheClosedFormOfItsLawAndHeat) {
  const FrictionModel model(TableOne());
  // kv v + sign(v) (kc + E)
  EXPECT_DOUBLE_EQ(model.Force(0.5), 2.5 + 15);
  EXPECT_DOUBLE_EQ(model.Force(-0.5), -2.5 - 15);
  EXPECT_DOUBLE_EQ(model.Force(0.5, {.energy = -6}), 2.5 + 15 - 6);
  EXPECT_EQ(model.Force(0), 0);
  EXPECT_DOUBLE_EQ(model.HoldingLevel(), 15);
}

TEST(FrictionModel, TakesLoadAmbientPositionAndStartsOfAMotion) {
  Friction friction = TableOne();
  friction.load_gain = 0.1;
  friction.level_per_temperature = -0.05;
  // one plain kernel of 2 N.m at 1 rad
  GaussianAxis kernel;
  kernel.centres = {1};
  kernel.width = 0.5;
  friction.maps = {{{{MapQuantity::position, kernel}}, KernelKind::plain, {2}}};
  JointTrajectory motion{Eigen::Vector3d(0, 60, 120), Eigen::Vector3d::Constant(0.5)};
  motion.position = Eigen::Vector3d(1, 1, 1.5);
  motion.load = Eigen::Vector3d(0, -20, 0);
  motion.ambient_rise = Eigen::Vector3d::Constant(10);
  motion.starts = {2};
  const Prediction made = FrictionModel(friction).Along(motion);
  EXPECT_DOUBLE_EQ(made.force[0], 2.5 + 15 + 2);
  // Eq. (22) with (1 - te) kT (Ts - T0) of the ambient
  const double te = std::exp(-0.1);
  const double energy = (1 - te) * (-3 * (2.5 + 15 + 2) * 0.5 - 0.05 * 10);
  EXPECT_NEAR(made.energy[1], energy, 1e-12);
  EXPECT_NEAR(made.force[1], 2.5 + 15 + 2 + 0.1 * 20 + energy, 1e-12);
  // cold again; one width from the kernel's centre
  EXPECT_EQ(made.energy[2], 0);
  EXPECT_NEAR(made.force[2], 2.5 + 15 + 2 * std::exp(-0.5), 1e-12);
}

TEST(FrictionModel, StepsAsThePluginDoes) {
  const double h = 0.002;
  const FrictionModel model(TableOne(), h);
  FrictionState state;
  double energy = 0;
  for (int i = 0; i < 1000; ++i) {
    const FrictionStep step = model.Step(state, {0, 0.5, 1, 0, 0});
    energy = std::exp(-h / 600) * energy - 3 * -std::expm1(-h / 600) * step.loss;
    state = step.next;
  }
  EXPECT_NEAR(state.energy, energy, 1e-12);
  // it slides: the force is that of the place
  EXPECT_NEAR(model.Step(state, {0, 0.5, 1, 0, 0}).force,
              model.Force(0.5, {.energy = state.energy}), 1e-9);
}

TEST(FrictionModel, RefusesWhatIsNoMotionAndNoFriction) {
  const FrictionModel model(TableOne());
  const JointTrajectory unlike{Eigen::Vector2d(0, 1), Eigen::VectorXd::Ones(1)};
  EXPECT_THROW(model.Along(unlike), BadInput);
  const JointTrajectory still{Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1)};
  EXPECT_THROW(model.Along(still), BadInput);
  JointTrajectory begins{Eigen::Vector2d(0, 1), Eigen::Vector2d(1, 1)};
  begins.starts = {2};
  EXPECT_THROW(model.Along(begins), BadInput);
  EXPECT_THROW(FrictionModel(TableOne(), 0), BadInput);
  Friction negative = TableOne();
  negative.parameters["coulomb"] = -1;
  EXPECT_THROW(FrictionModel{negative}, BadInput);
  EXPECT_THROW(SettledEnergy(TableOne(), NAN), BadInput);
}

}  // namespace
}  // namespace warmjoint
