// Identifiers on motion that never holds a speed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/prepared_log.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "identification/holdout/hold_out.h"
#include "identification/identifiers/identifier_list.h"
#include "tests/support/judging.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr, ::testing::Not;

using test::Excited, test::kInertia, test::kSine, test::kCosine;

Estimate AnswerTo(const std::string& name, const Measurements& m,
                  const std::map<std::string, std::string>& given = {{"gravity", "sincos"}}) {
  return test::Answer(name, m, given);
}

/// Within 4 standard deviations, and not by an interval that says nothing.
void ExpectTold(const Estimate& estimate, const std::string& name, double truth, double most) {
  const EstimatedParameter* one = estimate.Find(name);
  ASSERT_TRUE(one && one->std) << name << ": " << estimate.message;
  EXPECT_NEAR(one->value, truth, 4 * *one->std) << name;
  EXPECT_LT(*one->std, most) << name;
}

TEST(AnyMotion, NominalLawInertiaAndGravityAreToldTogether) {
  const Estimate estimate = AnswerTo("nominal-ls", Excited(test::Cold(), 6000, 1));
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  // white noise of 0.5 N.m on 5000 samples: some 0.5/sqrt(5000) = 0.007 over the columns' spread
  ExpectTold(estimate, "viscous", 5, 0.05);
  ExpectTold(estimate, "coulomb", 15, 0.05);
  ExpectTold(estimate, "inertia", kInertia, 0.02);
  ExpectTold(estimate, "gravity_sine", kSine, 0.05);
  ExpectTold(estimate, "gravity_cosine", kCosine, 0.05);
}

TEST(AnyMotion, WarmingIsToldBesideInertiaAndGravity) {
  Friction warm = test::TableOne();
  warm.thermal->time_constant = 100;
  const Estimate estimate = AnswerTo("energy-ml", Excited(warm, 25000, 2));
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  ExpectTold(estimate, "viscous", 5, 0.05);
  ExpectTold(estimate, "coulomb", 15, 0.1);
  ExpectTold(estimate, "thermal_gain", -3, 0.05);
  ExpectTold(estimate, "thermal_time_constant", 100, 3);
  ExpectTold(estimate, "inertia", kInertia, 0.02);
  ASSERT_EQ(estimate.state_end.size(), 2u);
  EXPECT_EQ(estimate.state_end[0].name, "time");
  EXPECT_EQ(estimate.state_end[1].name, "energy");
}

TEST(AnyMotion, AutoTakesItTogetherWithGravity) {
  Friction warm = test::TableOne();
  warm.thermal->time_constant = 100;
  const Estimate estimate = AnswerTo("auto", Excited(warm, 25000, 3), {});
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  ASSERT_TRUE(estimate.choice);
  EXPECT_EQ(estimate.choice->chosen, "energy-ml gravity=sincos law=viscous_coulomb");
  ExpectTold(estimate, "inertia", kInertia, 0.02);
}

TEST(AnyMotion, GravityThatIsLeftOutIsNamed) {
  const Estimate estimate = AnswerTo("nominal-ls", Excited(test::Cold(), 6000, 4), {});
  EXPECT_EQ(estimate.status, Status::inadequate_model);
  EXPECT_THAT(estimate.message, HasSubstr("--gravity sincos"));
}

TEST(AnyMotion, HeldOutFiguresAreOfTheSameModel) {
  const Identifier& identifier = FindIdentifier("nominal-ls");
  const Options options = identifier.options.Read({{"gravity", "sincos"}});
  const auto held =
      HoldOut(identifier, {Prepare(Excited(test::Cold(), 6000, 5)), options, {}}, 0.3).metrics;
  ASSERT_TRUE(held);
  // noise alone: 0.5 with a standard error of 0.5/sqrt(2 * 1500)
  EXPECT_NEAR(held->rmse, test::kExcitedNoise, 0.04);
}

/// A log whose torque comes some samples late.
Measurements Late(Measurements m, Eigen::Index samples) {
  const Eigen::Index n = m.size();
  const Eigen::VectorXd torque = m.torque;
  m.torque.tail(n - samples) = torque.head(n - samples);
  m.torque.head(samples).setConstant(torque[0]);
  return m;
}

TEST(AnyMotion, ATorqueThatIsLateIsToldWithItsDelay) {
  const Measurements in_time = Excited(test::Cold(), 6000, 7);
  const double step = in_time.time[1] - in_time.time[0];
  const Estimate estimate = AnswerTo("nominal-ls", Late(in_time, 2));
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  ExpectTold(estimate, "viscous", 5, 0.05);
  ExpectTold(estimate, "coulomb", 15, 0.05);
  ExpectTold(estimate, "inertia", kInertia, 0.02);
  ExpectTold(estimate, "torque_delay", 2 * step, 0.1 * step);
  // what follows from the estimate follows from the delay, too
  const Identifier& identifier = FindIdentifier("nominal-ls");
  const Options options = identifier.options.Read({{"gravity", "sincos"}});
  const auto held = HoldOut(identifier, {Prepare(Late(in_time, 2)), options, {}}, 0.3).metrics;
  ASSERT_TRUE(held);
  EXPECT_NEAR(held->rmse, test::kExcitedNoise, 0.04);

  // of one that is in time it is not told from 0, nor named, and one may be told to leave it out
  const Estimate punctual = AnswerTo("nominal-ls", in_time);
  ExpectTold(punctual, "torque_delay", 0, 0.1 * step);
  EXPECT_THAT(punctual.FullMessage(), Not(HasSubstr("late")));
  EXPECT_FALSE(
      AnswerTo("nominal-ls", Late(in_time, 2), {{"gravity", "sincos"}, {"torque_delay", "none"}})
          .Find("torque_delay"));
}

/// Moves of 3 rad back and forth at 1.5 rad/s and 6 rad/s^2, a pause of 0.3 s behind each; inertia and gravity as of Excited.
Measurements PickAndPlace(const Friction& friction, Eigen::Index n, std::uint64_t seed) {
  constexpr double step = 0.01, ramp = 0.25, cruise = 1.75, moves = cruise + 2 * ramp,
                   every = moves + 0.3;
  Eigen::VectorXd position(n), velocity(n), acceleration(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double t = step * static_cast<double>(i), move = std::floor(t / every);
    const double direction = std::fmod(move, 2) == 0 ? 1 : -1;
    // time since the move began, and until it ends
    const double since = t - every * move, left = std::max(moves - since, 0.0);
    const bool starts = since < ramp, ends = left < ramp;
    velocity[i] = direction * 6 * std::min({since, ramp, left});
    acceleration[i] = left == 0 ? 0 : direction * 6 * (starts ? 1 : ends ? -1 : 0);
    const double way = starts ? 3 * since * since
                       : ends ? 3 - 3 * left * left
                              : 1.5 * (since - ramp / 2);
    position[i] = direction * (way - 1.5);
  }
  Measurements m = test::RecordFriction(friction, step, velocity, test::kExcitedNoise, seed);
  m.position = position;
  m.torque += kInertia * acceleration;
  m.torque.array() += kSine * position.array().sin() + kCosine * position.array().cos();
  return m;
}

TEST(AnyMotion, CornersOfTheVelocityMakeNoDelay) {
  // losses of some 20 W, of which less than the friction may go
  Friction warm = test::TableOne();
  warm.thermal->gain = -0.3;
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const Estimate estimate = AnswerTo("energy-ml", PickAndPlace(warm, 60000, seed),
                                       {{"gravity", "sincos"}, {"motion", "any"}});
    ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
    ExpectTold(estimate, "viscous", 5, 0.05);
    ExpectTold(estimate, "inertia", kInertia, 0.02);
    ExpectTold(estimate, "torque_delay", 0, 0.01);
  }
}

TEST(AnyMotion, PositionsAloneMakeNoDelay) {
  // each other sample, positions in steps of an encoder of 16 bits
  const auto alone = [](Measurements m) {
    const auto half = Eigen::seq(0, m.size() - 2, 2);
    ForEachColumn(m, [&](Eigen::VectorXd& column) { column = column(half).eval(); });
    const double count = 2 * std::numbers::pi / 65536;
    m.position = (m.position / count).array().round() * count;
    m.velocity.resize(0);
    return m;
  };
  Friction warm = test::TableOne();
  warm.thermal->gain = -0.3;
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const Estimate estimate = AnswerTo("energy-ml", alone(PickAndPlace(warm, 90000, seed)),
                                       {{"gravity", "sincos"}, {"motion", "any"}});
    ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
    const auto& [lower, upper] = *estimate.Find("viscous")->interval95;
    // twice as far as it says, which a draw misses once in ten thousand
    EXPECT_LT(lower - (upper - lower) / 2, 5) << seed;
    EXPECT_GT(upper + (upper - lower) / 2, 5) << seed;
    EXPECT_NEAR(estimate.Find("inertia")->value, kInertia, 0.02) << seed;
  }
}

TEST(AnyMotion, MethodsThatKnowNoDelayNameIt) {
  const Estimate estimate = AnswerTo("position-ridge", Late(Excited(test::Cold(), 6000, 8), 5));
  EXPECT_EQ(estimate.status, Status::inadequate_model);
  EXPECT_THAT(estimate.message, HasSubstr("late against the positions"));
}

TEST(AnyMotion, IsRefusedWhereConstantSpeedIsAskedFor) {
  const Estimate estimate =
      AnswerTo("nominal-ls", Excited(test::TableOne(), 3000, 6), {{"motion", "constant"}});
  EXPECT_NE(estimate.status, Status::ok);
}

}  // namespace
}  // namespace warmjoint
