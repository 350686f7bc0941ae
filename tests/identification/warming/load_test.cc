// Friction that grows with what the joint carries: the column load, or the gravity that is fitted beside it.
#include "identification/warming/load.h"

#include <gmock/gmock.h>
#include <warmjoint/prepared_log.h>

#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "identification/answer/check_estimate.h"
#include "models/friction/along_motion.h"
#include "tests/support/judging.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

constexpr double kSine = 8, kCosine = -3;  // of gravity, N.m
constexpr double kNoise = 0.3;             // N.m

Friction Loaded(bool warms) {
  Friction friction{"viscous_coulomb", {{"viscous", 2}, {"coulomb", 4}}, {}, 0, 1};
  friction.load_gain = 0.2;
  if (warms) friction.thermal = Thermal{-0.5, 300};
  return friction;
}

enum class LoadColumn { absent, logged };

/// An hour at 1 s, of speeds held 20 s each, under gravity.
Measurements Record(const Friction& friction, LoadColumn column, std::uint64_t seed) {
  Measurements m =
      test::Record(1, test::AlternatingSpeeds(3600, seed), Eigen::VectorXd::Zero(3600));
  const Eigen::VectorXd gravity =
      kSine * m.position.array().sin() + kCosine * m.position.array().cos();
  JointTrajectory motion{m.time, m.velocity, m.position, MotorPosition(m)};
  motion.load = gravity;
  m.torque = AlongMotion(friction).Predict(motion).force + gravity;
  RandomStream random({seed, 0}, Stream::torque_noise);
  for (double& torque : m.torque) torque += kNoise * random.Normal();
  if (column == LoadColumn::logged) m.load = gravity;
  return m;
}

Estimate AnswerTo(const std::string& name, const Measurements& m,
                  std::map<std::string, std::string> given = {}) {
  given.insert({{"gravity", "sincos"}, {"load", "estimated"}});
  return test::Answer(name, m, given);
}

void ExpectWithin(const Estimate& estimate, const std::string& name, double truth) {
  const EstimatedParameter* one = estimate.Find(name);
  ASSERT_TRUE(one && one->std) << name << ": " << estimate.message;
  EXPECT_NEAR(one->value, truth, 4 * *one->std) << name;
}

TEST(Load, IsToldByTheGravityBesideIt) {
  for (const bool warms : {false, true}) {
    SCOPED_TRACE(warms);
    const Estimate estimate =
        AnswerTo(warms ? "energy-ml" : "nominal-ls", Record(Loaded(warms), LoadColumn::absent, 1));
    ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
    ExpectWithin(estimate, "load_gain", 0.2);
    ExpectWithin(estimate, "viscous", 2);
    ExpectWithin(estimate, "coulomb", 4);
    ExpectWithin(estimate, "gravity_sine", kSine);
    ExpectWithin(estimate, "gravity_cosine", kCosine);
    if (warms) ExpectWithin(estimate, "thermal_gain", -0.5);
    EXPECT_EQ(estimate.friction->load_gain, estimate.Find("load_gain")->value);
    // white noise over 3600 samples
    EXPECT_NEAR(estimate.metrics->rmse, kNoise, 4 * kNoise / std::sqrt(2 * 3600));
  }
}

TEST(Load, IsTheColumnWhereTheLogHasOne) {
  const Estimate estimate =
      AnswerTo("nominal-ls", Record(Loaded(false), LoadColumn::logged, 2), {{"gravity", "sincos"}});
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  ExpectWithin(estimate, "load_gain", 0.2);
  ExpectWithin(estimate, "coulomb", 4);
}

TEST(Load, ErrorsAreThoseOfManyDraws) {
  // by column and by gravity: squares of errors over standard errors of 40 draws are chi squared of 40, whose 0.1 % ends are 16
  // and 73
  for (const LoadColumn column : {LoadColumn::logged, LoadColumn::absent}) {
    std::map<std::string, double> squares;
    const std::map<std::string, double> truths{
        {"load_gain", 0.2}, {"coulomb", 4}, {"viscous", 2}, {"gravity_sine", kSine}};
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      const Measurements m = Record(Loaded(false), column, 100 + seed);
      const Estimate estimate =
          test::Fitted("nominal-ls", Prepare(m), {{"gravity", "sincos"}, {"load", "estimated"}});
      for (const auto& [name, truth] : truths) {
        const EstimatedParameter* one = estimate.Find(name);
        ASSERT_TRUE(one && one->std) << estimate.message;
        squares[name] += std::pow((one->value - truth) / *one->std, 2);
      }
    }
    for (const auto& [name, sum] : squares) {
      EXPECT_GT(sum, 16) << name;
      EXPECT_LT(sum, 73) << name;
    }
  }
}

TEST(Load, AutoTakesItWhereGravityActs) {
  const Estimate with =
      test::Answer("auto", Record(Loaded(false), LoadColumn::absent, 3), {{"gravity", "sincos"}});
  ASSERT_EQ(with.status, Status::ok) << with.message;
  ExpectWithin(with, "load_gain", 0.2);
  Friction plain = Loaded(false);
  plain.load_gain = 0;
  const Estimate without =
      test::Answer("auto", Record(plain, LoadColumn::absent, 4), {{"gravity", "sincos"}});
  EXPECT_EQ(without.status, Status::ok) << without.message;
  EXPECT_FALSE(without.Find("load_gain"));
}

TEST(Load, SpeedsAreThoseUnderTheMeanLoad) {
  const Measurements m = Record(Loaded(false), LoadColumn::absent, 5);
  const Estimate estimate = AnswerTo("nominal-ls", m);
  ASSERT_FALSE(estimate.friction_at_speeds.empty());
  // |8 sin p - 3 cos p| over whole turns: 2/pi of its amplitude, here within a tenth
  const double load = std::hypot(kSine, kCosine) * 2 / std::numbers::pi;
  for (const FrictionAtSpeed& one : estimate.friction_at_speeds) {
    const double truth = 4 + 2 * std::abs(one.speed) + 0.2 * load;
    EXPECT_NEAR(one.value, truth, 0.2 * 0.1 * load + 4 * one.std) << one.speed;
  }
}

TEST(Load, RestsAtItsBoundWhereFrictionDoesNotGrow) {
  // by its sign the noise pushes the gain of a plain friction below 0 in about half of the draws; none of 10: once in 1000
  int at_bound = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    Friction plain = Loaded(true);
    plain.load_gain = 0;
    const Estimate estimate = AnswerTo("energy-ml", Record(plain, LoadColumn::absent, 200 + seed));
    ASSERT_EQ(estimate.status, Status::ok) << estimate.FullMessage();
    ExpectWithin(estimate, "coulomb", 4);
    const EstimatedParameter* gain = estimate.Find("load_gain");
    ASSERT_TRUE(gain && gain->interval95);
    EXPECT_GE(gain->value, 0);
    at_bound += gain->value == 0;
    // at a gain of 0 friction at a speed is that of the law, and known as such
    ASSERT_FALSE(estimate.friction_at_speeds.empty());
    for (const FrictionAtSpeed& one : estimate.friction_at_speeds) {
      if (one.energy.value_or(0) != 0) continue;
      EXPECT_NEAR(one.value, 4 + 2 * std::abs(one.speed), 4 * one.std) << one.speed;
    }
  }
  EXPECT_GT(at_bound, 0);
}

TEST(Load, OfAnEstimateIsNotReadWhereTheLogHasNone) {
  // numbers under a logged load, held against a log without one, and without gravity
  Estimate estimate = AnswerTo("nominal-ls", Record(Loaded(false), LoadColumn::logged, 7));
  ASSERT_TRUE(estimate.Find("load_gain")) << estimate.message;
  estimate.gravity.reset();
  CheckEstimate(Prepare(test::RecordHour(test::Cold(), 1)), {}, estimate);
  EXPECT_EQ(estimate.status, Status::inadequate_model) << estimate.message;
}

TEST(Load, NeedsSomethingThatTellsIt) {
  const Measurements m = Record(Loaded(false), LoadColumn::absent, 6);
  const Estimate refused = AnswerTo("nominal-ls", m, {{"gravity", "none"}});
  EXPECT_EQ(refused.status, Status::bad_data);
  EXPECT_THAT(refused.message, HasSubstr("column load, or gravity"));
}

}  // namespace
}  // namespace warmjoint
