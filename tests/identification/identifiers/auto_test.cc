#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/prepared_log.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "identification/forward/log_trajectory.h"
#include "identification/identifiers/condense.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/identifiers/model_comparison.h"
#include "identification/identifiers/structures.h"
#include "models/foundation/low_pass.h"
#include "models/foundation/random_stream.h"
#include "models/recording/measurements.h"
#include "tests/support/judging.h"
#include "tests/support/travelling.h"
#include "tests/support/warm_recording.h"

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

TEST(Auto, ChoosesTheLawAndTheWarmingOfAJoint) {
  Friction warm_curve = test::TwoLevelStribeckJoint();
  warm_curve.thermal = Thermal{-3, 600};
  // levels that differ by 0.2 N.m, ten standard deviations
  const Friction two_levels{
      "asymmetric",
      {{"viscous", 5}, {"coulomb_positive", 15.1}, {"coulomb_negative", 14.9}},
      Thermal{-3, 600}};
  for (const Friction& joint : {test::TableOne(), test::Cold(), two_levels, test::StribeckJoint(),
                                test::TwoLevelStribeckJoint(), warm_curve}) {
    // at least 90 %
    EXPECT_GE(Chosen(joint), 9) << joint.law << ", warms: " << joint.thermal.has_value();
  }
}

TEST(Auto, TellsALoggedTemperatureFromTheHeatOfLosses) {
  constexpr double slope = -0.3;  // N.m/K
  Measurements warm =
      test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(3600, 1), 0.5, 1);
  const Eigen::ArrayXd rise =
      8 * (1 - (-(warm.time.array() - warm.time[0]) / (0.25 * warm.time[3599])).exp());
  warm.temperature = (20 + rise).matrix();
  // surroundings that warm a joint as its losses would
  Measurements follows =
      test::RecordFriction(test::Cold(), 1, test::AlternatingSpeeds(3600, 1), 0.5, 1);
  follows.torque.array() += slope * rise * follows.velocity.array().sign();
  follows.temperature = warm.temperature;
  const Estimate of_losses = test::Fitted("auto", warm, {{"fields", "auto"}}),
                 of_temperature = test::Fitted("auto", follows, {{"fields", "auto"}});
  EXPECT_NEAR(of_losses.Find("thermal_gain")->value, -3, 0.1) << of_losses.FullMessage();
  ASSERT_EQ(of_temperature.status, Status::ok) << of_temperature.FullMessage();
  EXPECT_FALSE(of_temperature.Find("thermal_gain"));
  EXPECT_NEAR(of_temperature.Find("coulomb")->value,
              test::Cold().parameters.at("coulomb") + slope * rise.mean(), 0.1);
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

/// What a simple structure and ten richer ones leave of unseen rows of noise, which is coloured. The richer ones have a wave
/// more each, with the coefficient that noise of the other rows gives it, and one of them has `gain` times a bump, too.
std::vector<StructureCandidate> SimpleAndRicher(std::uint64_t seed, double gain) {
  constexpr Eigen::Index n = 3000;
  RandomStream random({seed, 1}, Stream::test);
  Eigen::ArrayXd noise(n);
  double before = 0;
  for (Eigen::Index i = 0; i < n; ++i) noise[i] = before = 0.6 * before + random.Normal();
  // the bump is in a twentieth of the log
  Eigen::ArrayXd bump = Eigen::ArrayXd::Zero(n);
  bump.head(n / 20).setConstant(gain);
  std::vector<StructureCandidate> all{{"simple", noise + bump, 3}};
  const Eigen::ArrayXd place = Eigen::ArrayXd::LinSpaced(n, 0, 1);
  for (int k = 1; k <= 10; ++k) {
    // 2.5: what slow noise of this colour is larger by than white noise
    const Eigen::ArrayXd wave = 2.5 * random.Normal() * std::sqrt(2.0 / n) * (40 * k * place).sin();
    const Eigen::ArrayXd left = k == 7 ? noise : noise + bump;
    all.push_back({"richer", left + wave, 3.0 + k});
  }
  return all;
}

TEST(ChooseStructure, TakesARicherOneByChanceInFewLogs) {
  int richer = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    richer += ChooseStructure(SimpleAndRicher(seed, 0)).chosen != 0;
  }
  // 5 %, and three standard errors
  EXPECT_LE(richer, 26);
}

TEST(ChooseStructure, TakesARicherOneThatGainsInASmallPartOfTheLog) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    EXPECT_EQ(ChooseStructure(SimpleAndRicher(seed, 4)).chosen, 7) << seed;
  }
}

/// What came of a structure that auto lists; nothing where it does not.
std::optional<StructureTrial> TrialOf(const Estimate& estimate, const std::string& name) {
  const auto& trials = estimate.choice->trials;
  const auto found = std::ranges::find(trials, name, &StructureTrial::name);
  return found == trials.end() ? std::nullopt : std::optional(*found);
}

TEST(Auto, SaysWhyAndListsWhatItTried) {
  const Estimate estimate = AnswerTo(test::RecordHour(test::TableOne(), 1));
  EXPECT_EQ(estimate.identifier, "auto");
  EXPECT_THAT(estimate.message, HasSubstr("chose energy-ml law=viscous_coulomb: every other"));
  ASSERT_TRUE(estimate.choice);
  EXPECT_EQ(estimate.choice->chosen, "energy-ml law=viscous_coulomb");
  const auto dropped = [&](const std::string& name) {
    const auto trial = TrialOf(estimate, name);
    return trial ? trial->dropped : "not tried";
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
    const Estimate estimate = AnswerTo(test::RecordHour(joint, 1));
    return TrialOf(estimate, "energy-ml gravity=sincos law=viscous_coulomb").value().parameters > 0;
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

/// A warming joint with ripple over its position, which carries a weight of so many N.m.
Estimate OfRippleBesideWeight(double weight) {
  Friction joint = test::TableOne();
  joint.maps = {test::PositionLevel(3, 1.5)};
  Measurements m = test::RecordFriction(joint, 1, test::Travel(6000, 1, 3, {0.15, 0.3, 0.6}), 0, 1);
  m.position.array() -= 3;
  m.torque = PredictFriction(joint, LogSamples(m)).force;
  m.torque.array() += weight * m.position.array().sin();
  test::AddNoise(m, 0.5, 0, 7);
  return AnswerTo(m);
}

TEST(Auto, TellsGravityFromAMap) {
  // a map could be both, but only friction belongs into a simulator that adds gravity of its own
  const Estimate heavy = OfRippleBesideWeight(5);
  ASSERT_TRUE(heavy.gravity) << heavy.message;
  EXPECT_FALSE(heavy.friction->maps.empty());
  EXPECT_TRUE(test::Holds(heavy, "gravity_sine", 5));

  const Estimate light = OfRippleBesideWeight(0);
  EXPECT_FALSE(light.gravity) << light.message;
  EXPECT_FALSE(light.friction->maps.empty()) << light.message;
}

TEST(Auto, LeavesMapsOutWhereNothingIsLeftOverPlace) {
  // with fields it tries none
  const Estimate estimate =
      test::Answer("auto", test::RecordHour(test::TableOne(), 3), {{"fields", "none"}});
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
  const Eigen::VectorXd velocity = test::Finer(test::AlternatingSpeeds(3600, 5), 10);
  Measurements m = test::RecordFriction(test::TableOne(), 0.1, velocity, 0, 5);
  m.torque = LowPass(m.time, m.torque, 0.4);
  test::AddNoise(m, 0.5, 0, 5);
  const Estimate estimate = AnswerTo(m);
  ASSERT_TRUE(estimate.choice);
  EXPECT_EQ(estimate.choice->chosen, "energy-ml law=viscous_coulomb torque_lag=estimated");
  EXPECT_TRUE(test::Holds(estimate, "torque_lag", 0.4));
}

TEST(Auto, BeginsAsWarmAsItIsTold) {
  // a joint that has moved for 10 min before the log begins
  const Friction truth = test::TableOne();
  const Measurements all = test::RecordFriction(truth, 1, test::AlternatingSpeeds(4200, 7), 0.5, 7);
  const double energy = PredictFriction(truth, LogSamples(all)).energy[600];
  const Measurements log = test::Without(all, {{-1, 599.5}});
  const Estimate estimate = test::Fitted("auto", log,
                                         {{"initial_energy", "expected"},
                                          {"expected_energy", std::to_string(energy)},
                                          {"expected_energy_std", "0.05"}});
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  test::ExpectTold(
      estimate, {{"initial_energy", energy}, {"thermal_gain", -3}, {"thermal_time_constant", 600}},
      4, 0.1);
}

TEST(Auto, ComparesOnFewerRowsAndFitsEverySample) {
  // an hour at 10 Hz: 36 000 samples
  const Eigen::VectorXd velocity = test::Finer(test::AlternatingSpeeds(3600, 2), 10);
  const Estimate estimate = AnswerTo(test::RecordFriction(test::TableOne(), 0.1, velocity, 0.5, 2));
  ASSERT_TRUE(estimate.metrics);
  EXPECT_GT(estimate.metrics->n, 34000);
  EXPECT_EQ(estimate.choice->chosen, "energy-ml law=viscous_coulomb");
  // means over twelve samples leave 0.5/sqrt(12) of the noise
  for (const StructureTrial& one : estimate.choice->trials) {
    EXPECT_TRUE(one.name != estimate.choice->chosen || *one.rmse < 0.25);
  }
}

TEST(ModelComparison, ChoosesAnotherWhereTheBestLeavesItsBoundsOnEverySample) {
  const Measurements m =
      test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(3600, 2), 0.5, 2);
  const IdentifierInput input{Prepare(m), FindIdentifier("auto").options, {}};
  ModelComparison comparison(input, input.selection);
  comparison.Add(ColdStructures(FittedGravity::none));
  comparison.Add(WarmStructures(FittedGravity::none));
  const Structure best = *comparison.Best();
  EXPECT_TRUE(best.CanWarm());

  comparison.DropBeyondBounds(best);
  comparison.DropDominated();
  EXPECT_NE(comparison.Best()->Name(), best.Name());
  const std::vector<StructureTrial> trials = comparison.Reported();
  EXPECT_NE(std::ranges::find(trials, best.Name(), &StructureTrial::name)->dropped, "");
  EXPECT_EQ(std::ranges::find(trials, comparison.Best()->Name(), &StructureTrial::name)->dropped,
            "");
}

LogView Steady() {
  const Measurements m =
      test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(3600, 1), 0, 1);
  return Prepare(m).constant_speed();
}

TEST(Condense, MakesRowsOfOneSegment) {
  const LogView all = Steady();
  const LogView some = Condense(all, 900).view;
  EXPECT_LT(some.selection.count(), all.selection.count() / 3);
  ASSERT_EQ(some.selection.segments.size(), all.selection.segments.size());
  for (const Segment& one : some.selection.segments) {
    for (Eigen::Index i = one.begin; i < one.end; ++i) {
      EXPECT_NEAR(some.measurements.velocity[i], one.velocity, 1e-9);
    }
  }
}

TEST(Condense, KeepsTheWayAndTheTime) {
  const LogView all = Steady();
  const auto [some, first] = Condense(all, 900);
  const auto& a = all.measurements;
  const auto& b = some.measurements;
  for (Eigen::Index i = 1; i < b.size(); ++i) EXPECT_GT(b.time[i], b.time[i - 1]);
  EXPECT_NEAR(b.time[b.size() - 1], a.time[a.size() - 1], 4);

  // a row stands among its samples
  ASSERT_EQ(first.size(), static_cast<size_t>(b.size()) + 1);
  EXPECT_EQ(first.back(), a.size());
  for (Eigen::Index i = 0; i < b.size(); ++i) {
    EXPECT_GE(b.time[i], a.time[first[static_cast<size_t>(i)]]);
    EXPECT_LE(b.time[i], a.time[first[static_cast<size_t>(i) + 1] - 1]);
  }
}

/// Five holds of 10 s, then one of 100 s: the times between their rows look like gaps.
TEST(Condense, KeepsTheGapsOfTheSamples) {
  std::vector<double> speeds;
  for (int hold = 0; hold < 120; ++hold) {
    const double speed = (hold % 2 == 0 ? 1 : -1) * (0.2 + 0.1 * (hold % 7));
    speeds.insert(speeds.end(), hold % 6 == 5 ? 100 : 10, speed);
  }
  const Eigen::VectorXd velocity = Eigen::VectorXd::Map(speeds.data(), std::ssize(speeds));
  Measurements m = test::RecordFriction(test::TableOne(), 1, velocity, 0, 1);
  LogView some = Condense(Prepare(m).constant_speed(), 30).view;
  EXPECT_FALSE(GapsOf(some.measurements.time).empty());
  ASSERT_TRUE(some.measurements.gaps);
  EXPECT_TRUE(some.measurements.gaps->empty());

  // a clock that stood still for a minute
  m.time.tail(1500).array() += 60;
  some = Condense(Prepare(m).constant_speed(), 30).view;
  ASSERT_EQ(some.measurements.gaps->size(), 1u);
  const LogGap& gap = some.measurements.gaps->front();
  EXPECT_EQ(gap.length, 61);
  EXPECT_GT(some.measurements.time[gap.behind], m.time[m.size() - 1500]);
  EXPECT_LT(some.measurements.time[gap.behind - 1], m.time[m.size() - 1501]);
}

}  // namespace
}  // namespace warmjoint
