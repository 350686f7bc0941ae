#include "identification/preparation/segment_velocity.h"

#include <gmock/gmock.h>
#include <warmjoint/prepared_log.h>

#include <cmath>

#include "identification/answer/identify.h"
#include "identification/fit/seen_samples.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/preparation/select.h"
#include "tests/support/judging.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using ::testing::HasSubstr;

/// Table I without warming at 10 Hz, speeds of U(0.1, 1) rad/s held for 20 s.
/// noise: of the velocity, rad/s; encoder: resolution of the position, rad, 0: fine.
struct Noisy {
  double noise = 0.05, encoder = 0;
  Index speeds = 30;
  std::uint64_t seed = 1;

  Eigen::VectorXd Truth() const {
    return test::Finer(test::AlternatingSpeeds(20 * speeds, seed), 10);
  }

  Measurements Log() const {
    Measurements m = test::RecordFriction(test::Cold(), 0.1, Truth(), 0.3, seed);
    RandomStream random({seed, 0}, Stream::velocity_noise);
    for (double& v : m.velocity) v += noise * random.Normal();
    if (encoder > 0) m.position = encoder * (m.position / encoder).array().round();
    return m;
  }
};

double LargestError(const Eigen::VectorXd& velocity, const Eigen::VectorXd& truth,
                    const Selection& kept) {
  return (kept.keep.select((velocity - truth).array(), 0.0)).abs().maxCoeff();
}

TEST(SegmentVelocity, MeasuresNoiseAndAttenuation) {
  const Noisy noisy{};
  const Measurements m = noisy.Log();
  const Selection selection = SelectConstantSpeed(m);
  const auto taken = TakeSegmentVelocity(m, selection);
  ASSERT_TRUE(taken);
  // 6000 samples: the deviation is known to 1/sqrt(12000) = 0.9 %; three of these
  EXPECT_NEAR(taken->noise.noise, 0.05, 0.05 * 0.028);

  // the closed form, of the true speeds of what is kept
  const Eigen::VectorXd truth = noisy.Truth();
  double count = 0, sum = 0, squares = 0;
  for (Index i = 0; i < m.size(); ++i) {
    if (!selection.keep[i]) continue;
    ++count;
    sum += std::abs(truth[i]);
    squares += truth[i] * truth[i];
  }
  const double between = squares / count - std::pow(sum / count, 2);
  const double expected = 0.05 * 0.05 / (0.05 * 0.05 + between);
  EXPECT_NEAR(taken->noise.attenuation, expected, 0.06 * expected) << "twice 2.8 %";
}

TEST(SegmentVelocity, TakesWhatIsSurerOfPositionAndVelocity) {
  const Noisy fine{};
  Measurements m = fine.Log();
  Selection selection = SelectConstantSpeed(m);
  auto taken = TakeSegmentVelocity(m, selection);
  ASSERT_TRUE(taken);
  EXPECT_LT(LargestError(taken->velocity, fine.Truth(), selection), 1e-9) << "exact positions";

  // steps of 1 rad in 2 to 20 rad tell less than 200 samples of the velocity
  const Noisy coarse{.encoder = 1};
  m = coarse.Log();
  selection = SelectConstantSpeed(m);
  taken = TakeSegmentVelocity(m, selection);
  ASSERT_TRUE(taken);
  const double deviation = 0.05 / std::sqrt(200.0);
  const double error = LargestError(taken->velocity, coarse.Truth(), selection);
  EXPECT_LT(error, 5 * deviation);
  EXPECT_GT(error, 0.1 * deviation);
}

TEST(SegmentVelocity, LeavesLogsAloneWhoseNoiseIsHarmless) {
  for (const double noise : {0.0, 1e-12, 0.001, 0.005}) {
    const Measurements m = Noisy{.noise = noise}.Log();
    EXPECT_FALSE(TakeSegmentVelocity(m, SelectConstantSpeed(m))) << noise;
  }
  const Measurements m = Noisy{}.Log();
  EXPECT_FALSE(TakeSegmentVelocity(m, SelectMoving(m))) << "no segments are known";
}

TEST(SegmentVelocity, KeepsADriftOfTheSpeed) {
  Measurements m = Noisy{.noise = 0.02}.Log();
  Selection selection;
  selection.keep.setConstant(m.size(), true);
  for (Index i = 0; i < m.size(); i += 200) selection.segments.push_back({i, i + 200, 0});
  Eigen::VectorXd drift(m.size());
  for (Index i = 0; i < m.size(); ++i) drift[i] = 0.1 * (static_cast<double>(i % 200) / 200 - 0.5);
  m.velocity += drift;
  const auto taken = TakeSegmentVelocity(m, selection);
  ASSERT_TRUE(taken);
  EXPECT_NEAR(taken->noise.noise, 0.02, 0.02 * 0.028);
  const Eigen::VectorXd rest = taken->velocity - drift - Noisy{}.Truth();
  // a line through 200 samples of 0.02: twice 0.02/sqrt(200) at its ends, four of these
  EXPECT_LT(rest.cwiseAbs().maxCoeff(), 8 * 0.02 / std::sqrt(200.0));
}

TEST(SegmentVelocity, LetsIntervalsHold) {
  int held = 0, ok = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Measurements m = Noisy{.seed = seed}.Log();
    const Estimate estimate = test::Answer("nominal-ls", Prepare(m, SelectConstantSpeed(m)));
    if (estimate.status != Status::ok) continue;
    ++ok;
    held += test::Holds(estimate, "viscous", 5);
    EXPECT_THAT(estimate.message, HasSubstr("velocity averaged over each segment"));
  }
  // of 100 at 95 %, fewer than 87 come once in a thousand times
  EXPECT_GE(ok, 95);
  EXPECT_GE(held, ok - 13);
}

}  // namespace
}  // namespace warmjoint
