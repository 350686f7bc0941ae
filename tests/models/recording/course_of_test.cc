#include "models/recording/course_of.h"

#include <gtest/gtest.h>

#include "tests/support/warm_recording.h"

namespace warmjoint {
namespace {

TEST(PredictFriction, FollowsTheGoldenClosedLoop) {
  const nlohmann::json& golden = test::Golden().at("closed_sim");
  const double h = 0.25;
  const Thermal thermal = Continuous({golden.at("ke"), golden.at("te")}, h);
  const Friction friction{"viscous_coulomb",
                          {{"viscous", golden.at("kv")}, {"coulomb", golden.at("kc")}},
                          thermal,
                          0,
                          1};
  const Eigen::VectorXd velocity = test::ToVector(golden.at("v"));
  const Measurements motion = test::Record(h, velocity, 0 * velocity);

  const Prediction prediction = PredictFriction(friction, motion, {golden.at("E0")});
  // 1e-12: closed form, through one logarithm and back
  const Eigen::VectorXd force = test::ToVector(golden.at("F"));
  EXPECT_LT((prediction.force - force).norm(), 1e-12 * force.norm());
  const Eigen::VectorXd energy = test::ToVector(golden.at("E"));
  EXPECT_LT((prediction.energy - energy).norm(), 1e-12 * energy.norm());
  EXPECT_EQ(prediction.feeds_itself, motion.size());
}

TEST(PredictFriction, HoldsTheNominalLawWhereNothingWarms) {
  Friction friction = test::TableOne();
  friction.thermal.reset();
  const Eigen::VectorXd velocity = test::AlternatingSpeeds(100, 1, 30);
  const Prediction prediction = PredictFriction(friction, test::Record(1, velocity, 0 * velocity));
  for (Eigen::Index i = 0; i < 100; ++i) {
    EXPECT_DOUBLE_EQ(prediction.force[i], 5 * velocity[i] + 15 * Sign(velocity[i]));
  }
}

TEST(PredictFriction, CoolsThroughAGapInTime) {
  Measurements motion = test::Record(1, Eigen::VectorXd::Zero(5), Eigen::VectorXd::Zero(5));
  motion.time << 0, 1, 2, 602, 603;
  const Prediction prediction = PredictFriction(test::TableOne(), motion, {-8});
  // 1e-12: closed form
  EXPECT_NEAR(prediction.energy[3], -8 * std::exp(-602.0 / 600), 8e-12);
}

TEST(PredictFriction, SaysWhereFrictionFeedsItself) {
  // warm at 1.2 rad/s for an hour, then creep: E is below the level of slow friction
  Eigen::VectorXd velocity = Eigen::VectorXd::Constant(3600, 1.2);
  velocity.tail(1000).setConstant(0.05);
  Friction friction = test::TableOne();
  friction.parameters["viscous"] = 20;
  const Prediction prediction = PredictFriction(friction, test::Record(1, velocity, 0 * velocity));
  EXPECT_EQ(prediction.feeds_itself, 2600);
}

TEST(PredictFriction, BendsTheBristleAsTheTorqueTells) {
  // 1 s at 0.001 rad/s: the bristle of 2000 N.m/rad takes up 2 N.m on the way, from 3 N.m on
  Friction friction;
  friction.law = "lugre";
  friction.parameters = {{"viscous", 0},
                         {"coulomb", 15},
                         {"static", 15},
                         {"stribeck_velocity", 0.1},
                         {"bristle_stiffness", 2000},
                         {"bristle_damping", 0}};
  Measurements m =
      test::Record(0.01, Eigen::VectorXd::Constant(101, 0.001), Eigen::VectorXd::Zero(101));
  m.torque[0] = 3;
  const Eigen::VectorXd sliding = PredictFriction(friction, m).force;
  EXPECT_NEAR(sliding[0], 15, 1e-9);
  EXPECT_NEAR(sliding[100], 15, 1e-9);
  const Eigen::VectorXd bent = PredictFriction(friction, m, {}, BristleStart::torque).force;
  EXPECT_NEAR(bent[0], 3, 1e-9);
  // ds/dx = sigma0 (1 - s/15)
  EXPECT_NEAR(bent[100], 15 - 12 * std::exp(-2000 * 0.001 / 15), 1e-9);
}

}  // namespace
}  // namespace warmjoint
