// How well a torque along a log follows the true friction.
#include "identification/score/compensation_score.h"

#include <gtest/gtest.h>

#include <cmath>

#include "models/foundation/bad_input.h"
#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

using Eigen::VectorXd;

constexpr double kRate = 20;  // Hz
constexpr int kSeconds = 7200;
constexpr double kNoise = 0.5;  // N.m

/// Two hours to and fro at 0.5 rad/s in holds of 10 s, a rest of a quarter of an hour from 3600 s on; friction of 10 N.m.
struct Case {
  Measurements log;
  Truth truth;
  VectorXd contact;

  Case() {
    const int n = static_cast<int>(kRate) * kSeconds;
    log.time = VectorXd::LinSpaced(n, 0, (n - 1) / kRate);
    truth.velocity = log.time.unaryExpr([](double t) {
      if (t >= 3600 && t < 4500) return 0.0;
      return std::fmod(t, 20) < 10 ? 0.5 : -0.5;
    });
    truth.force = 20 * truth.velocity;
    log.velocity = truth.velocity;
    log.position = VectorXd::Zero(n);
    log.torque = truth.force;
    RandomStream random({1, 1}, Stream::torque_noise);
    for (double& one : log.torque) one += kNoise * random.Normal();
    contact = VectorXd::Zero(n);
  }

  CompensationScore Of(const VectorXd& found) const {
    return ScoreCompensation(found, LogSamples(log), truth, contact);
  }
};

TEST(ScoreCompensation, IsZeroForTheTruthAndHundredForNothing) {
  const Case one;
  const CompensationScore truth = one.Of(one.truth.force);
  EXPECT_EQ(truth.residual, 0);
  EXPECT_EQ(truth.worst_minute, 0);
  EXPECT_TRUE(std::isnan(truth.contact_bias));
  const CompensationScore none = one.Of(VectorXd::Zero(one.log.time.size()));
  EXPECT_NEAR(none.residual, 100, 1e-9);
  EXPECT_NEAR(none.after_starts, 100, 1e-9);

  // four samples of white noise: passed twice among some 24000 means, by 3.9 deviations of a mean
  EXPECT_NEAR(truth.push, 3.9 * kNoise / 2, 0.15);
  EXPECT_GT(none.push, 10);
}

TEST(ScoreCompensation, FindsWhenItIsWrong) {
  // half of the friction is missed in the first five minutes after the rest
  const Case one;
  VectorXd found = one.truth.force;
  for (Eigen::Index i = 0; i < found.size(); ++i) {
    if (one.log.time[i] >= 4500 && one.log.time[i] < 4800) found[i] *= 0.5;
  }
  const CompensationScore score = one.Of(found);
  EXPECT_NEAR(score.worst_minute, 50, 1e-6);
  EXPECT_EQ(score.median_minute, 0);
  // five of the twenty minutes after the two starts; of 105 that move
  EXPECT_NEAR(score.after_starts, 50 * std::sqrt(5.0 / 20), 0.5);
  EXPECT_NEAR(score.residual, 50 * std::sqrt(5.0 / 105), 0.2);
  EXPECT_EQ(score.by_minute.size(), 120);
  EXPECT_TRUE(std::isnan(score.by_minute[65])) << "it rests";
  EXPECT_NEAR(score.by_minute[77], 50, 1e-6);
}

TEST(ScoreCompensation, LeavesOutAJointThatCreepsWhileItIsHeld) {
  // a drive holds it against a load, and its log has it at rest
  Case one;
  for (Eigen::Index i = 0; i < one.truth.velocity.size(); ++i) {
    if (one.log.velocity[i] != 0) continue;
    one.truth.velocity[i] = 1e-7;
    one.truth.force[i] = 9;
    one.log.torque[i] += 9;
  }
  VectorXd found = one.truth.force;
  found = (one.log.velocity.array() == 0).select(0, found);
  const CompensationScore score = one.Of(found);
  EXPECT_EQ(score.residual, 0);
  EXPECT_EQ(score.after_starts, 0);
  EXPECT_TRUE(std::isnan(score.by_minute[65]));
  EXPECT_LT(score.push, 1.2);
}

TEST(ScoreCompensation, TellsTheBiasOfAContact) {
  // 2 N.m for ten minutes, of which the compensator takes up 0.5
  Case one;
  VectorXd found = one.truth.force;
  for (Eigen::Index i = 0; i < found.size(); ++i) {
    if (one.log.time[i] < 600 || one.log.time[i] >= 1200) continue;
    one.contact[i] = 2;
    one.log.torque[i] += 2;
    found[i] += 0.5;
  }
  const CompensationScore score = one.Of(found);
  EXPECT_NEAR(score.contact_bias, -0.5, 0.02);
  // means of twenty samples
  EXPECT_NEAR(score.contact_width, 1.96 * kNoise / std::sqrt(20.0), 0.03);
}

TEST(ScoreCompensation, RefusesAnotherLength) {
  const Case one;
  EXPECT_THROW(one.Of(VectorXd::Zero(7)), BadInput);
}

}  // namespace
}  // namespace warmjoint
