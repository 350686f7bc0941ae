#include <gmock/gmock.h>

#include "models/foundation/low_pass.h"
#include "models/foundation/random_stream.h"
#include "models/recording/measurements.h"
#include "tests/support/judging.h"
#include "tests/support/slow_recording.h"
#include "tests/support/travelling.h"
#include "tests/support/without_times.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

Estimate AnswerTo(const Measurements& m) { return test::Fitted("auto", m); }

/// How many of 10 realizations choose that law, with that warming.
int Chosen(const Friction& truth) {
  int chosen = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const bool curved = truth.parameters.contains("stribeck_velocity");
    const Eigen::VectorXd velocity =
        curved ? test::SlowAndFast(3600, seed) : test::AlternatingSpeeds(3600, seed);
    const Estimate estimate = AnswerTo(test::RecordFriction(truth, 1, velocity, 0.5, seed));
    if (!estimate.friction) continue;
    chosen += estimate.friction->law == truth.law && estimate.friction->maps.empty() &&
              estimate.friction->thermal.has_value() == truth.thermal.has_value();
  }
  return chosen;
}

// at least 90 %
constexpr int kAtLeast = 9;

TEST(Auto, ChoosesWarmingForTableOne) { EXPECT_GE(Chosen(test::TableOne()), kAtLeast); }

TEST(Auto, ChoosesNoWarmingForAColdJoint) { EXPECT_GE(Chosen(test::Cold()), kAtLeast); }

TEST(Auto, ChoosesALevelForEachDirectionWhereTheyDiffer) {
  // by 0.2 N.m, ten standard deviations
  EXPECT_GE(Chosen({"asymmetric",
                    {{"viscous", 5}, {"coulomb_positive", 15.1}, {"coulomb_negative", 14.9}},
                    Thermal{-3, 600}}),
            kAtLeast);
}

TEST(Auto, ChoosesTheStribeckLawWhereSlowSpeedsShowIt) {
  EXPECT_GE(Chosen(test::StribeckJoint()), kAtLeast);
}

TEST(Auto, ChoosesALevelForEachDirectionBesideTheStribeckLaw) {
  Friction joint = test::TwoLevelStribeckJoint();
  EXPECT_GE(Chosen(joint), kAtLeast);
  joint.thermal = Thermal{-3, 600};
  EXPECT_GE(Chosen(joint), kAtLeast);
}

TEST(Auto, FindsTwoLevelsBesideASmallFall) {
  // the difference of the levels hides the fall from the law with one
  Friction joint = test::TwoLevelStribeckJoint();
  joint.parameters["coulomb_negative"] = 5;
  joint.parameters["static_rise"] = 1;
  const Estimate estimate =
      AnswerTo(test::RecordFriction(joint, 1, test::SlowAndFast(3600, 4), 0.5, 4));
  ASSERT_TRUE(estimate.friction) << estimate.message;
  EXPECT_EQ(estimate.friction->law, "asymmetric_stribeck") << estimate.message;
}

TEST(Auto, SaysWhyAndListsWhatItTried) {
  const Estimate estimate =
      AnswerTo(test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(3600, 1), 0.5, 1));
  EXPECT_EQ(estimate.identifier, "auto");
  EXPECT_THAT(estimate.message,
              HasSubstr("chose energy-ml law=viscous_coulomb: it outdoes every other"));
  ASSERT_TRUE(estimate.choice);
  EXPECT_EQ(estimate.choice->chosen, "energy-ml law=viscous_coulomb");
  const auto dropped = [&](const std::string& name) {
    for (const StructureTrial& one : estimate.choice->trials) {
      if (one.name == name) return one.dropped;
    }
    return std::string("not tried");
  };
  EXPECT_EQ(dropped("energy-ml law=viscous_coulomb"), "");
  EXPECT_THAT(dropped("energy-ml law=asymmetric"),
              HasSubstr("outdone by energy-ml law=viscous_coulomb"));
  EXPECT_NE(dropped("stribeck warming=none"), "not tried");
  EXPECT_EQ(dropped("stribeck law=asymmetric_stribeck warming=none"), "not tried");
  EXPECT_NE(dropped("energy-ml gravity=sincos law=asymmetric"), "not tried");
}

TEST(Auto, TriesNoWarmingBesideGravityWhereNeitherIsSeen) {
  const auto tried = [](const Friction& joint) {
    const Estimate estimate =
        AnswerTo(test::RecordFriction(joint, 1, test::AlternatingSpeeds(3600, 1), 0.5, 1));
    for (const StructureTrial& one : estimate.choice->trials) {
      if (one.name == "energy-ml gravity=sincos law=viscous_coulomb") return one.parameters > 0;
    }
    ADD_FAILURE() << "not told";
    return false;
  };
  EXPECT_FALSE(tried(test::Cold()));
  EXPECT_TRUE(tried(test::TableOne()));
}

TEST(Auto, TakesALawWithoutSlopeWhereThereIsOneSpeed) {
  Eigen::VectorXd velocity(3600);
  for (Eigen::Index i = 0; i < 3600; ++i) velocity[i] = i / 20 % 2 ? -0.5 : 0.5;
  const Estimate estimate = AnswerTo(test::RecordFriction(test::TableOne(), 1, velocity, 0.5, 1));
  ASSERT_TRUE(estimate.friction) << estimate.message;
  EXPECT_EQ(estimate.friction->law, "coulomb");
  EXPECT_TRUE(estimate.friction->thermal.has_value());
}

TEST(Auto, FindsGravity) {
  Measurements m =
      test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(3600, 1), 0.5, 1);
  m.torque.array() += 4 * m.position.array().sin() + 2 * m.position.array().cos();
  const Estimate estimate = AnswerTo(m);
  ASSERT_TRUE(estimate.choice);
  EXPECT_EQ(estimate.choice->chosen, "energy-ml gravity=sincos law=viscous_coulomb");
  EXPECT_TRUE(estimate.gravity.has_value());
}

/// A warming joint with ripple over its position, which carries a weight of so many N.m.
Estimate OfRippleBesideWeight(double weight) {
  Friction joint = test::TableOne();
  joint.maps = {test::PositionLevel(3, 1.5)};
  Measurements m = test::RecordFriction(joint, 1, test::Travel(6000, 1, 3, {0.15, 0.3, 0.6}), 0, 1);
  m.position.array() -= 3;
  m.torque = PredictFriction(joint, m).force;
  m.torque.array() += weight * m.position.array().sin();
  test::AddNoise(m, 0.5, 0, 7);
  return AnswerTo(m);
}

TEST(Auto, TellsGravityFromAMap) {
  // a map could be both, but only friction belongs into a simulator that adds gravity of its own
  const Estimate heavy = OfRippleBesideWeight(5);
  ASSERT_TRUE(heavy.gravity) << heavy.message;
  EXPECT_FALSE(heavy.friction->maps.empty());
  const auto& interval = *heavy.Find("gravity_sine")->interval95;
  EXPECT_LT(interval[0], 5);
  EXPECT_GT(interval[1], 5);

  const Estimate light = OfRippleBesideWeight(0);
  EXPECT_FALSE(light.gravity) << light.message;
  EXPECT_FALSE(light.friction->maps.empty());
}

TEST(Auto, LeavesMapsOutWhereNothingIsLeftOverPlace) {
  const Estimate estimate =
      AnswerTo(test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(3600, 3), 0.5, 3));
  ASSERT_TRUE(estimate.choice);
  int maps = 0;
  for (const StructureTrial& one : estimate.choice->trials) {
    const bool is_map = one.name.find("position-ridge") != std::string::npos ||
                        one.name.find("position=map") != std::string::npos;
    maps += is_map;
    EXPECT_TRUE(!is_map || (!one.rmse && one.parameters == 0)) << one.name;
  }
  EXPECT_GE(maps, 2);
}

TEST(Auto, FindsALagOfTheTorque) {
  Eigen::VectorXd velocity(36000);
  const Eigen::VectorXd speeds = test::AlternatingSpeeds(3600, 5);
  for (Eigen::Index i = 0; i < 36000; ++i) velocity[i] = speeds[i / 10];
  Measurements m = test::RecordFriction(test::TableOne(), 0.1, velocity, 0, 5);
  m.torque = LowPass(m.time, m.torque, 0.4);
  RandomStream random({5, 0}, Stream::test);
  for (double& torque : m.torque) torque += 0.5 * random.Normal();
  const Estimate estimate = AnswerTo(m);
  ASSERT_TRUE(estimate.choice);
  EXPECT_EQ(estimate.choice->chosen, "energy-ml law=viscous_coulomb torque_lag=estimated");
  ASSERT_NE(estimate.Find("torque_lag"), nullptr);
  const auto& interval = *estimate.Find("torque_lag")->interval95;
  EXPECT_LT(interval[0], 0.4);
  EXPECT_GT(interval[1], 0.4);
}

TEST(Auto, BeginsAsWarmAsItIsTold) {
  // a joint that has moved for 10 min before the log begins
  const Friction truth = test::TableOne();
  const Measurements all = test::RecordFriction(truth, 1, test::AlternatingSpeeds(4200, 7), 0.5, 7);
  const double energy = PredictFriction(truth, all).energy[600];
  const Measurements log = test::Without(all, {{-1, 599.5}});
  const Estimate estimate = test::Fitted("auto", log,
                                         {{"initial_energy", "expected"},
                                          {"expected_energy", std::to_string(energy)},
                                          {"expected_energy_std", "0.05"}});
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  for (const auto& [name, value] :
       {std::pair("initial_energy", energy), std::pair("thermal_gain", -3.0),
        std::pair("thermal_time_constant", 600.0)}) {
    const EstimatedParameter* found = estimate.Find(name);
    ASSERT_TRUE(found && found->std) << name;
    EXPECT_NEAR(found->value, value, 4 * *found->std) << name;
    EXPECT_LT(*found->std, 0.1 * std::abs(value)) << name;
  }
}

TEST(Auto, ComparesOnFewerRowsAndFitsEverySample) {
  // an hour at 10 Hz: 36 000 samples
  Eigen::VectorXd velocity(36000);
  const Eigen::VectorXd speeds = test::AlternatingSpeeds(3600, 2);
  for (Eigen::Index i = 0; i < 36000; ++i) velocity[i] = speeds[i / 10];
  const Estimate estimate = AnswerTo(test::RecordFriction(test::TableOne(), 0.1, velocity, 0.5, 2));
  ASSERT_TRUE(estimate.metrics);
  EXPECT_GT(estimate.metrics->n, 34000);
  EXPECT_EQ(estimate.choice->chosen, "energy-ml law=viscous_coulomb");
  // means over twelve samples leave 0.5/sqrt(12) of the noise
  for (const StructureTrial& one : estimate.choice->trials) {
    EXPECT_TRUE(one.name != estimate.choice->chosen || *one.rmse < 0.25);
  }
}

}  // namespace
}  // namespace warmjoint
