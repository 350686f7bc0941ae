#include <gmock/gmock.h>

#include <cmath>

#include "identification/forward/log_trajectory.h"
#include "identification/forward/thermal_filter.h"
#include "tests/support/judging.h"
#include "tests/support/travelling.h"

namespace warmjoint {
namespace {

using test::Answer;
using test::Count;
using test::CountAlarms;
using test::CountRejected;
using test::kInadequate;
using test::kNearlyAll;
using test::RecordHour;
using ::testing::HasSubstr;
using ::testing::Not;

/// Table I with E(0), N.m.
Measurements Started(double energy, std::uint64_t seed, double noise = 0.5) {
  Measurements m = RecordHour(test::TableOne(), seed, 0);
  m.torque = PredictFriction(test::TableOne(), LogSamples(m), {energy}).force;
  test::AddNoise(m, noise, 0, seed);
  return m;
}

TEST(JudgeHeat, FindsASecondStageOfHeat) {
  // a film of grease, 60 s, beside the housing, 600 s
  const auto two = [](std::uint64_t seed) {
    Measurements m = RecordHour(test::TableOne(), seed);
    const ThermalFilter filter(m.time);
    const Eigen::VectorXd loss = m.torque.cwiseProduct(m.velocity).cwiseAbs();
    m.torque += m.velocity.array().sign().matrix().asDiagonal() * filter.Energy({-0.5, 60}, loss);
    return m;
  };
  EXPECT_GE(Count("energy-ml", kInadequate, two), kNearlyAll);
  EXPECT_THAT(Answer("energy-ml", two(1)).message, HasSubstr("one time constant is too few"));
}

TEST(JudgeHeat, FindsAWarmStart) {
  // E(0) is known to 0.33 N.m here: -3 is nine deviations, -1 is three
  const auto warm = [](std::uint64_t seed) { return Started(-3, seed); };
  EXPECT_GE(CountAlarms("energy-ml", warm), kNearlyAll);
}

TEST(JudgeHeat, GivesNoIntervalOfAWarmingBesideADrift) {
  // half a sine in the hour, of which the warming takes up a part that nobody can tell
  Measurements m = RecordHour(test::TableOne(), 1);
  const Eigen::ArrayXd phase = M_PI / 3600 * m.time.array();
  m.torque.array() += 0.5 * m.velocity.array().sign() * phase.sin();
  const Estimate estimate = Answer("energy-ml", m);
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  EXPECT_THAT(estimate.FullMessage(), HasSubstr("the residual depends on time"));
  EXPECT_FALSE(estimate.Find("thermal_gain")->std || estimate.Find("thermal_gain")->interval95);
  EXPECT_FALSE(estimate.Find("thermal_pole")->interval95);
  EXPECT_TRUE(estimate.Find("viscous")->interval95);
}

TEST(JudgeHeat, FindsAMapThatFadesWithTheHeat) {
  // 0.06 N.m of ripple over the position when cold, less with every degree; 0.01 N.m of noise
  Friction fading{
      "viscous_coulomb", {{"viscous", 0.05}, {"coulomb", 0.5}}, Thermal{-0.2, 180}, 0, 1};
  FrictionMap ripple = test::PositionLevel(1.5, 0.06);
  Friction steady = fading;
  steady.maps = {ripple};
  ripple.axes.push_back({MapQuantity::energy, EvenAxis(-0.1, 0, 2)});
  FrictionMap faded = ripple;
  faded.weights.clear();
  for (const double weight : ripple.weights) faded.weights.insert(faded.weights.end(), {0, weight});
  fading.maps = {faded};
  const auto record = [](const Friction& friction) {
    return test::RecordFriction(friction, 0.2, test::Travel(6000, 0.2, 1.5, {0.3, 0.6, 1, 1.5}),
                                0.01, 1);
  };
  const std::map<std::string, std::string> few{{"kernels", "30"}, {"width", "1"}};
  auto map = few;
  map["position"] = "map";
  const Estimate told = Answer("energy-ml", record(fading), map);
  EXPECT_THAT(told.FullMessage(), HasSubstr("depends on position x energy"));
  EXPECT_THAT(told.FullMessage(), HasSubstr("try --identifier energy-map"));
  EXPECT_THAT(Answer("energy-ml", record(steady), map).FullMessage(), Not(HasSubstr("depends on")));

  // the map over the energy follows it; gain and maps then share what fades
  const Estimate followed = Answer("energy-map", record(fading), few);
  ASSERT_EQ(followed.status, Status::ok) << followed.message;
  EXPECT_FALSE(followed.Find("thermal_gain")->interval95);
}

TEST(JudgeHeat, FindsASlopeThatWarms) {
  Measurements m = RecordHour(test::TableOne(), 1);
  m.torque +=
      0.1 * m.velocity.cwiseProduct(PredictFriction(test::TableOne(), LogSamples(m)).energy);
  const Estimate estimate = Answer("energy-ml", m);
  EXPECT_THAT(estimate.FullMessage(), HasSubstr("speed x energy"));
  EXPECT_THAT(estimate.FullMessage(), HasSubstr("try --identifier lpv-energy"));
}

TEST(JudgeHeat, FindsALoadThatTheLogHolds) {
  // a tenth of 0 and 20 N.m in turn of five minutes
  const auto loaded = [](std::uint64_t seed) {
    Measurements m = RecordHour(test::TableOne(), seed);
    m.load = Eigen::VectorXd::Zero(m.size());
    for (Eigen::Index i = 0; i < m.size(); ++i) (*m.load)[i] = i / 300 % 2 == 0 ? 0 : 20;
    // the noise stays, the friction is that under the load
    Friction friction = test::TableOne();
    const LogSamples samples(m);
    m.torque -= PredictFriction(friction, samples).force;
    friction.load_gain = 0.1;
    m.torque += PredictFriction(friction, samples).force;
    return m;
  };
  EXPECT_GE(CountRejected("energy-ml", "load", loaded), kNearlyAll);
  EXPECT_THAT(Answer("energy-ml", loaded(1)).FullMessage(),
              HasSubstr("try --identifier energy-ml --set load=estimated"));
  const Estimate followed = Answer("energy-ml", loaded(1), {{"load", "estimated"}});
  ASSERT_EQ(followed.status, Status::ok) << followed.message;
  EXPECT_NEAR(followed.Find("load_gain")->value, 0.1, 0.01);
  Measurements unmoved = RecordHour(test::TableOne(), 1);
  unmoved.load = loaded(1).load;
  EXPECT_THAT(Answer("energy-ml", unmoved).FullMessage(), Not(HasSubstr("depends on")));
}

TEST(JudgeHeat, FindsATemperatureThatTheLogHolds) {
  // a room of 20 to 26 degrees; slope: N.m for each
  const auto in_room = [](const Friction& friction, double slope) {
    Measurements m = RecordHour(friction, 1);
    m.temperature = (23 + 3 * (2 * M_PI / 1800 * m.time.array()).sin()).matrix();
    m.torque.array() -= slope * m.velocity.array().sign() * (m.temperature->array() - 20);
    return m;
  };
  // about the mean of 23 degrees it is 0.64 N.m rms, 4 % of the friction, or 2.5 N.m, more than the 10 % of --relevance
  const Estimate slight = Answer("energy-ml", in_room(test::TableOne(), 0.3));
  const Estimate strong = Answer("nominal-ls", in_room(test::Cold(), 1.2));
  EXPECT_EQ(slight.status, Status::ok);
  EXPECT_EQ(strong.status, kInadequate);
  for (const Estimate& one : {slight, strong}) {
    EXPECT_THAT(one.FullMessage(), HasSubstr("depends on temperature"));
    EXPECT_THAT(one.FullMessage(), HasSubstr("record it at a steady temperature"));
  }
}

TEST(JudgeHeat, SaysThatAJointWasWarmAtTheStart) {
  const Measurements m = Started(-6, 1, 0.1);
  EXPECT_THAT(Answer("energy-ml", m).FullMessage(), HasSubstr("--start estimated"));
  const Estimate right = Answer("energy-ml", m, {{"initial_energy", "estimated"}});
  EXPECT_EQ(right.status, Status::ok) << right.message;
}

}  // namespace
}  // namespace warmjoint
