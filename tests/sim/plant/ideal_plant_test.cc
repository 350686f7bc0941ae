#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/plant/plant.h"
#include "tests/support/golden.h"
#include "tests/support/refusal.h"
#include "tests/support/table1.h"

namespace warmjoint {
namespace {

using test::Table1;

Simulation Simulate(const Scenario& scenario, std::uint64_t realization = 0) {
  return MakePlant(scenario)->Run(realization);
}

TEST(IdealPlant, LogsThePlanOneSampleForEachPeriod) {
  const Simulation recording = Simulate(Table1());
  const Measurements& log = recording.measurements;
  ASSERT_EQ(log.size(), 3600);
  EXPECT_EQ(log.torque_unit, "N.m");
  EXPECT_EQ(log.velocity, recording.truth.velocity);
  EXPECT_EQ(recording.truth.torque_noise, 0.5);
  EXPECT_EQ(recording.truth.plant, "ideal");
  EXPECT_EQ(log.position[0], 0);
  for (Eigen::Index i = 0; i < log.size(); ++i) {
    EXPECT_EQ(log.time[i], i);
    // each speed for 20 s, to and fro; positions of tens of radians round at 1e-14
    EXPECT_EQ(log.velocity[i], log.velocity[i / 20 * 20]) << "sample " << i;
    EXPECT_EQ(log.velocity[i] > 0, i / 20 % 2 == 0);
    const Eigen::Index before = std::max<Eigen::Index>(i - 1, 0);
    const double way = i > 0 ? log.velocity[before] : 0;
    EXPECT_NEAR(log.position[i] - log.position[before], way, 1e-12);
  }
}

TEST(IdealPlant, LosesByTheSpeedWhereHoldsEndBetweenSamples) {
  // a hundred times as fast the ends of the holds are met to 4 ms
  Scenario slow = Table1();
  slow.motion.hold = 20.37;
  Scenario fast = slow;
  fast.sampling.rate = 100;
  const Eigen::VectorXd energy = Simulate(slow).truth.energy;
  const Eigen::VectorXd fine = Simulate(fast).truth.energy;
  const Eigen::VectorXd at_samples = fine(Eigen::seq(0, Eigen::last, 100));
  ASSERT_EQ(at_samples.size(), energy.size());
  // losses that follow the heat within a second: dE/dt of 0.04 N.m/s over 600 s; by samples alone it is 0.05 N.m
  EXPECT_LE((energy - at_samples).cwiseAbs().maxCoeff(), 0.01);
}

TEST(IdealPlant, StaysBetweenTheLimitsItTravels) {
  Scenario scenario = Table1();
  scenario.motion.hold = 0;
  scenario.motion.travel.limits = {-0.5, 2.0};
  scenario.sampling.rate = 20;
  const Measurements log = Simulate(scenario).measurements;
  // 1440 turns of limits added up round at 1e-12
  EXPECT_GE(log.position.minCoeff(), -0.5 - 1e-9);
  EXPECT_LE(log.position.maxCoeff(), 2.0 + 1e-9);
  EXPECT_LT(log.position.minCoeff(), -0.4);
  EXPECT_GT(log.position.maxCoeff(), 1.9);
}

TEST(IdealPlant, AddsWhiteNoisesOfTheGivenDeviationsIndependently) {
  Scenario scenario = Table1();
  scenario.noise = {0.5, 1.0, 1.0};
  const Simulation recording = Simulate(scenario);
  const Measurements exact = Simulate(Table1()).measurements;
  const Eigen::ArrayXd torque = recording.measurements.torque - recording.truth.force;
  const Eigen::ArrayXd velocity = recording.measurements.velocity - recording.truth.velocity;
  const Eigen::ArrayXd position = recording.measurements.position - exact.position;
  const Eigen::Index n = torque.size();
  const double variance = 0.25;
  // mean: sd 0.5 / 60; variance: sd 0.25 sqrt(2 / 3600); lag-one product: sd 0.25 / 60; bounds 5 sd
  EXPECT_NEAR(torque.mean(), 0, 5 * 0.5 / 60);
  EXPECT_NEAR(torque.square().mean(), variance, 5 * variance * std::sqrt(2.0 / 3600));
  EXPECT_NEAR((torque.head(n - 1) * torque.tail(n - 1)).mean(), 0, 5 * variance / 60);
  EXPECT_NEAR(velocity.square().mean(), 1, 5 * std::sqrt(2.0 / 3600));
  // a product of two standard normals has sd 1; bounds 5 sd / sqrt(3600)
  EXPECT_NEAR((torque * velocity).mean(), 0, 0.5 * 5.0 / 60);
  EXPECT_NEAR((torque * position).mean(), 0, 0.5 * 5.0 / 60);
  EXPECT_NEAR((velocity * position).mean(), 0, 5.0 / 60);
}

TEST(IdealPlant, RepeatsItsBitsForTheSameSeedAndRealizationOnly) {
  const auto plant = MakePlant(Table1());
  const Eigen::VectorXd third = plant->Run(3).measurements.torque;
  EXPECT_NE(plant->Run(4).measurements.torque, third);
  EXPECT_EQ(plant->Run(3).measurements.torque, third);
  Scenario other = Table1();
  other.seed = 2;
  EXPECT_NE(Simulate(other, 3).measurements.torque, third);

  // and the motion whatever the noise
  Scenario loud = Table1();
  loud.noise.torque = 5;
  EXPECT_EQ(Simulate(loud).truth.force, Simulate(Table1()).truth.force);
}

TEST(IdealPlant, DrawsATruthForEachRealization) {
  Scenario scenario = Table1();
  scenario.draws.numbers["friction.parameters.viscous"] = {Distribution::Kind::uniform, 4, 6};
  const double first = Simulate(scenario, 1).truth.friction.parameters.at("viscous");
  EXPECT_NE(Simulate(scenario, 2).truth.friction.parameters.at("viscous"), first);
  EXPECT_EQ(Simulate(scenario, 1).truth.friction.parameters.at("viscous"), first);
}

TEST(IdealPlant, RefusesJointLimitsItDoesNotKnow) {
  Scenario scenario = Table1();
  scenario.motion.hold = 0;
  scenario.motion.travel.joint_limits = true;
  test::ExpectNamed(test::RefusalOf([&] { MakePlant(scenario); }),
                    {scenario.name + ": ", "ideal", "limits"});
}

TEST(IdealPlant, FollowsCornersWithInertia) {
  // up to 1 rad/s within a second, steady for one, and so on for ever
  Scenario scenario = Table1();
  scenario.noise.torque = 0;
  scenario.friction.thermal.reset();
  scenario.motion = {};
  scenario.motion.corners = {{0, 0}, {1, 1}, {2, 1}};
  scenario.disturbances.hidden.inertia.inertia = 2;
  scenario.sampling.rate = 10;
  scenario.duration = 2;
  const Simulation recording = MakeIdealPlant(scenario)->Run(0);
  const Measurements& m = recording.measurements;

  // 5 v + 15 + 2 a; at the corner the slopes of both sides count half
  EXPECT_NEAR(m.velocity[5], 0.5, 1e-12);
  EXPECT_NEAR(m.torque[5], 2.5 + 15 + 2, 1e-9);
  EXPECT_NEAR(m.torque[10], 5 + 15 + 1, 1e-9);
  EXPECT_NEAR(m.torque[15], 5 + 15, 1e-9);
}

TEST(IdealPlant, ChangesSpeedsByRamps) {
  Scenario scenario = test::Table1();
  scenario.noise.torque = 0;
  scenario.sampling.rate = 10;
  scenario.duration = 600;
  scenario.controller.acceleration = 0.5;
  const Simulation ramped = MakePlant(scenario)->Run(0);
  const Measurements& m = ramped.measurements;
  const Eigen::VectorXd steps = m.velocity.tail(m.size() - 1) - m.velocity.head(m.size() - 1);
  EXPECT_LE(steps.cwiseAbs().maxCoeff(), 0.05 + 1e-12);

  // trapezoids between stored samples miss a corner by a tenth of a second's acceleration at most
  for (Eigen::Index i = 1; i < m.size(); ++i) {
    const double way = 0.05 * (m.velocity[i] + m.velocity[i - 1]);
    EXPECT_NEAR(m.position[i] - m.position[i - 1], way, 0.5 * 0.01 / 4);
  }

  // the speeds themselves are those of the plan with jumps, which each ramp leads to
  scenario.controller.acceleration = 0;
  const Simulation jumping = MakePlant(scenario)->Run(0);
  for (Eigen::Index i = 0; i < m.size(); i += 200) {
    EXPECT_NEAR(m.velocity[i], jumping.measurements.velocity[i], 1e-9);
  }
}

// recordings that the project did not make
TEST(IdealPlant, LogsTheGoldenRecordingOfEveryLawThatSlidesSteadily) {
  for (const char* name : {"coulomb", "viscous_coulomb", "asymmetric", "stiction", "stribeck",
                           "asymmetric_stribeck"}) {
    const test::GoldenMotion golden = test::ReadGoldenMotion(name);
    const nlohmann::json plan = test::ReadGolden(name);
    Scenario scenario = test::Table1();
    scenario.friction = golden.friction;
    scenario.motion.speeds.draws.reset();
    scenario.motion.speeds.list = plan.at("speeds").get<std::vector<double>>();
    scenario.motion.hold = plan.at("hold");
    scenario.noise.torque = 0;
    scenario.sampling.rate = 1 / golden.trajectory.step;
    scenario.duration = golden.trajectory.step * static_cast<double>(golden.force.size());
    const Simulation recording = MakePlant(scenario)->Run(0);
    EXPECT_EQ(recording.measurements.velocity, golden.trajectory.velocity) << name;
    // the same equations: rounding of 600 steps at 20 N.m
    EXPECT_LT((recording.measurements.torque - golden.force).cwiseAbs().maxCoeff(), 2e-12) << name;
    EXPECT_LT((recording.truth.energy - golden.energy).cwiseAbs().maxCoeff(), 2e-12) << name;
  }
}

}  // namespace
}  // namespace warmjoint
