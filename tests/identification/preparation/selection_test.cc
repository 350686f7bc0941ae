#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "identification/preparation/select.h"
#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// A velocity, and where it is constant and not 0.
struct Motion {
  double step = 0;  // s
  std::vector<double> velocity;
  std::vector<bool> constant;

  Measurements Log() const {
    Measurements log;
    const auto n = static_cast<Index>(velocity.size());
    log.time = VectorXd::LinSpaced(n, 0, step * static_cast<double>(n - 1));
    log.velocity = Eigen::Map<const VectorXd>(velocity.data(), n);
    return log;
  }
};

struct Plan {
  double step = 1;          // s
  double hold = 20;         // s at each speed
  double acceleration = 0;  // rad/s^2 between speeds; 0: jumps
  double settling = 0;      // s, time constant of a first-order lag on the speed; 0: none
  double rest = 0;          // s of rest after each second speed
  int speeds = 40;
};

/// Speeds of U(0.1, 1) rad/s, the sign alternating.
Motion Alternating(const Plan& plan) {
  RandomStream random({1, 2}, Stream::test);
  Motion motion{plan.step, {}, {}};
  double v = 0, lagged = 0;
  const auto hold = [&](double target, double duration) {
    // the ramp, then the speed itself
    const double ramp = plan.acceleration > 0 ? std::abs(target - v) / plan.acceleration : 0;
    const double start = v;
    const auto samples = static_cast<int>(std::lround((duration + ramp) / plan.step));
    for (int i = 0; i < samples; ++i) {
      const double t = (i + 1) * plan.step;
      v = t < ramp ? start + (target - start) * t / ramp : target;
      const double share = plan.settling > 0 ? -std::expm1(-plan.step / plan.settling) : 1;
      lagged += share * (v - lagged);
      motion.velocity.push_back(lagged);
      // settled: acceleration below a hundredth of its start
      motion.constant.push_back(target != 0 && t >= ramp + 4.6 * plan.settling);
    }
    v = target;
  };
  for (int i = 0; i < plan.speeds; ++i) {
    hold((i % 2 == 0 ? 1 : -1) * random.Uniform(0.1, 1), plan.hold);
    if (plan.rest > 0 && i % 2 == 1) hold(0, plan.rest);
  }
  return motion;
}

Motion WithNoise(Motion motion, double noise) {
  RandomStream random({3, 4}, Stream::test);
  for (double& v : motion.velocity) v += noise * random.Normal();
  return motion;
}

/// Shares that a selection gets right.
struct Outcome {
  double kept = 0;   // of the samples at a constant speed, how many are kept
  double wrong = 0;  // of the kept samples, how many are not at a constant speed
};

Outcome Judge(const Motion& motion) {
  const Selection selection = SelectConstantSpeed(motion.Log());
  double constant = 0, right = 0;
  for (std::size_t i = 0; i < motion.constant.size(); ++i) {
    constant += motion.constant[i];
    right += motion.constant[i] && selection.keep[static_cast<Index>(i)];
  }
  const auto kept = static_cast<double>(selection.count());
  return {right / constant, kept > 0 ? (kept - right) / kept : 0};
}

TEST(SelectConstantSpeed, KeepsEverySampleBetweenJumps) {
  for (const double step : {1.0, 5.0, 0.05}) {  // 20, 4 and 400 samples a plateau
    const Motion motion = Alternating({.step = step});
    const Selection selection = SelectConstantSpeed(motion.Log());
    EXPECT_EQ(selection.count(), selection.keep.size()) << step;
    EXPECT_EQ(selection.segments.size(), 40U) << step;
  }
}

TEST(SelectConstantSpeed, KeepsNeighboursOfAlmostOneSpeed) {
  Motion motion{1, {}, {}};
  for (int plateau = 0; plateau < 60; ++plateau) {
    for (int i = 0; i < 4; ++i) motion.velocity.push_back(0.5 + 0.007 * (plateau % 3));
  }
  const Selection selection = SelectConstantSpeed(motion.Log());
  EXPECT_EQ(selection.count(), 240);
  EXPECT_EQ(selection.segments.size(), 60U);
}

TEST(SelectConstantSpeed, LeavesRestsOut) {
  const Motion motion = Alternating({.rest = 30});
  const Outcome outcome = Judge(motion);
  EXPECT_EQ(outcome.kept, 1);
  EXPECT_EQ(outcome.wrong, 0);

  // rests that the sensor does not see as exactly 0
  const Outcome noisy = Judge(WithNoise(motion, 0.01));
  EXPECT_GT(noisy.kept, 0.97);
  EXPECT_EQ(noisy.wrong, 0);
}

TEST(SelectConstantSpeed, CutsRampsAtEveryRate) {
  for (const double rate : {20.0, 250.0, 1000.0}) {
    const Plan plan{.step = 1 / rate, .hold = 2, .acceleration = 5};
    const Motion motion = Alternating(plan);
    for (const double noise : {0.0, 0.001, 0.01}) {
      const Outcome outcome = Judge(WithNoise(motion, noise));
      EXPECT_GT(outcome.kept, 0.95) << rate << " Hz, noise " << noise;
      // ramps hide within 4 noise of the level for 4 noise / acceleration at each end of a hold
      const double hidden = 2 * 4 * noise / plan.acceleration / plan.hold;
      EXPECT_LE(outcome.wrong, hidden) << rate << " Hz, noise " << noise;
    }
  }
}

TEST(SelectConstantSpeed, WaitsUntilAControllerHasSettled) {
  for (const double rate : {1.0, 20.0, 250.0}) {
    const Outcome outcome = Judge(Alternating({.step = 1 / rate, .settling = 0.05}));
    EXPECT_GT(outcome.kept, 0.97) << rate << " Hz";
    EXPECT_LT(outcome.wrong, 0.002) << rate << " Hz";
  }
}

TEST(SelectConstantSpeed, KeepsASpeedThatRippleOfTheLoadLetsWobbleInTheMiddle) {
  // 1.5 % of the speed, in the middle third of each way, without any noise
  Motion motion = Alternating({.step = 0.05, .settling = 0.05});
  for (std::size_t i = 0; i < motion.velocity.size(); ++i) {
    const auto within = static_cast<double>(i % 400);
    if (within < 133 || within >= 266) continue;
    motion.velocity[i] *= 1 + 0.015 * std::sin(2 * std::numbers::pi * (within - 133) / 133);
  }
  const Outcome outcome = Judge(motion);
  EXPECT_GT(outcome.kept, 0.97);
  EXPECT_LT(outcome.wrong, 0.002);
}

TEST(SelectConstantSpeed, KeepsThePeaksOfAMotorsRippleAtASlowSpeed) {
  // noise of 0.003 rad/s, whose band is 0.012; a speed of 0.1 rad/s that ripples by -0.009 to 0.017 from 0.1 on, twelve samples a turn
  Motion motion = WithNoise(Alternating({.step = 0.05}), 0.003);
  std::size_t slow = 0, kept = 0;
  for (std::size_t i = 0; i < 800; ++i) {
    const double angle = 0.5 * static_cast<double>(i);
    const double direction = i < 400 ? 1 : -1;
    motion.velocity[i] = direction * (0.1 + 0.012 * std::sin(angle) - 0.005 * std::cos(2 * angle));
  }
  const Selection selection = SelectConstantSpeed(motion.Log());
  for (Index i = 0; i < 800; ++i) {
    if (std::abs(motion.velocity[static_cast<std::size_t>(i)]) < 0.115) continue;
    ++slow;
    kept += selection.keep[i] ? 1 : 0;
  }
  EXPECT_GT(slow, 60U);
  EXPECT_GT(static_cast<double>(kept), 0.95 * static_cast<double>(slow));
}

TEST(SelectConstantSpeed, LeavesOutTheCreepOfAReversal) {
  // at 20 Hz: presliding holds the speed for half a second on the way from each speed to the next
  Motion motion = Alternating({.step = 0.05});
  for (std::size_t i = 400; i < motion.velocity.size(); ++i) {
    if (i % 400 >= 10) continue;
    motion.velocity[i] = 0.1 * motion.velocity[i + 20];
    motion.constant[i] = false;
  }
  const Outcome outcome = Judge(motion);
  EXPECT_GT(outcome.kept, 0.99);
  EXPECT_EQ(outcome.wrong, 0);
}

TEST(SelectConstantSpeed, KeepsNothingOfASinusoid) {
  for (const double rate : {10.0, 100.0, 1000.0}) {
    Motion motion{1 / rate, {}, {}};
    for (int i = 0; i < 20000; ++i) {
      motion.velocity.push_back(std::sin(0.3 * std::numbers::pi * i / rate));
    }
    for (const double noise : {0.0, 0.003, 0.03}) {
      const Selection selection = SelectConstantSpeed(WithNoise(motion, noise).Log());
      EXPECT_LT(static_cast<double>(selection.count()), 0.01 * 20000) << rate << " " << noise;
    }
  }
}

TEST(SelectConstantSpeed, SeesThroughAQuantisedVelocity) {
  Motion motion = WithNoise(Alternating({.step = 0.01, .hold = 5, .acceleration = 5}), 0.005);
  for (double& v : motion.velocity) v = 0.024 * std::round(v / 0.024);
  const Outcome outcome = Judge(motion);
  EXPECT_GT(outcome.kept, 0.95);
  EXPECT_LT(outcome.wrong, 0.005);
}

TEST(SelectConstantSpeed, DropsSingleOutliersAlone) {
  Motion motion = WithNoise(Alternating({.step = 0.05}), 0.002);
  for (std::size_t i = 50; i < motion.velocity.size(); i += 400) {
    motion.velocity[i] += 1;
    motion.constant[i] = false;
  }
  const Selection selection = SelectConstantSpeed(motion.Log());
  EXPECT_EQ(selection.segments.size(), 40U);
  const Outcome outcome = Judge(motion);
  EXPECT_GT(outcome.kept, 0.98);
  EXPECT_EQ(outcome.wrong, 0);
}

TEST(SelectConstantSpeed, FollowsASpeedThatDriftsSlowly) {
  // ten minutes at a speed that changes by a tenth, between fast reversals
  Motion motion{0.05, {}, {}};
  for (int run = 0; run < 4; ++run) {
    for (int i = 0; i < 12000; ++i) {
      motion.velocity.push_back((run % 2 == 0 ? 1 : -1) * 0.5 * (1 + 0.1 * i / 12000));
      motion.constant.push_back(true);
    }
  }
  EXPECT_GT(Judge(WithNoise(motion, 0.001)).kept, 0.95);
}

TEST(SelectConstantSpeed, EndsASegmentAtAGapInTime) {
  Motion motion{0.1, std::vector<double>(100, 0.5), {}};
  Measurements log = motion.Log();
  log.time.tail(50).array() += 7;
  const Selection selection = SelectConstantSpeed(log);
  ASSERT_EQ(selection.segments.size(), 2U);
  EXPECT_EQ(selection.segments[0].end, 50);
  EXPECT_EQ(selection.segments[1].begin, 50);
  EXPECT_DOUBLE_EQ(selection.segments[1].velocity, 0.5);
}

TEST(SelectConstantSpeed, TakesFewSamples) {
  for (int n = 3; n < 12; ++n) {
    Motion motion{1, std::vector<double>(static_cast<std::size_t>(n), 0.5), {}};
    EXPECT_EQ(SelectConstantSpeed(motion.Log()).count(), n);
    motion.velocity.assign(static_cast<std::size_t>(n), 0);
    EXPECT_EQ(SelectConstantSpeed(motion.Log()).count(), 0);
  }
}

TEST(SelectMoving, KeepsEverySampleThatMoves) {
  Motion motion{1, {0, 0.5, 0, -1e-9}, {}};
  const Selection selection = SelectMoving(motion.Log());
  EXPECT_EQ(selection.count(), 2);
  EXPECT_TRUE(selection.keep[1] && selection.keep[3]);
}

}  // namespace
}  // namespace warmjoint
