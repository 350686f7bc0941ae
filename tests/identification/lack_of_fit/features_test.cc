// What features look at: by hand, and what changes within each hold of constant speed and what outlasts it in logs.
#include "identification/lack_of_fit/features.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/judging.h"

namespace warmjoint {
namespace {

constexpr int kLogs = 20;

/// Table I beside a torque against the motion that swells and ebbs with every hold of 20 s. level: N.m
Measurements Swelling(double level, std::uint64_t seed) {
  Measurements m = test::RecordHour(test::TableOne(), seed);
  const auto wave = (std::numbers::pi / 20 * m.time.array()).sin().abs();
  m.torque.array() += level * m.velocity.array().sign() * wave;
  return m;
}

/// Table I whose friction follows the speed late in part. slope: N.m.s/rad; time_constant: s
Measurements Late(double slope, double time_constant, std::uint64_t seed) {
  Measurements m = test::RecordHour(test::TableOne(), seed);
  double followed = std::abs(m.velocity[0]);
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    const double speed = std::abs(m.velocity[i]);
    m.torque[i] += std::copysign(slope, m.velocity[i]) * (followed - speed);
    followed += -std::expm1(-1 / time_constant) * (speed - followed);
  }
  return m;
}

bool Holds(const Estimate& estimate, const std::string& name, double truth) {
  const EstimatedParameter* one = estimate.Find(name);
  if (!one->interval95) return true;
  const auto [lower, upper] = *one->interval95;
  return lower <= truth && truth <= upper;
}

/// Bins of one sample each over a log, forwards and backwards in turn, whose segments are not known.
Bins EvenBins(Eigen::Index count) {
  Bins bins;
  bins.weight = Eigen::VectorXd::Ones(count);
  bins.velocity.resize(count);
  bins.time.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    bins.begin.push_back(i);
    bins.end.push_back(i + 1);
    bins.velocity[i] = i % 2 == 0 ? 0.5 : -0.5;
    bins.time[i] = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
  }
  return bins;
}

/// A fit of one level that leaves this.
GrowingFit Leaving(const Bins& bins, const Eigen::VectorXd& residual) {
  return {bins.weight,
          residual,
          Eigen::MatrixXd::Ones(bins.size(), 1),
          {Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(bins.size(), true), {}}};
}

TEST(Period, IsThatOfTheWaveAmongThoseHalfACycleApart) {
  const Bins bins = EvenBins(400);
  const GrowingFit fit = Leaving(bins, (2 * std::numbers::pi * 7 * bins.time.array()).cos());
  Circumstances known;
  known.duration = 100;
  // 2.5 to 20 cycles, one a hold; to a quarter of the bins where no holds are known
  known.hold = 5;
  EXPECT_EQ(OfPeriod(bins, known, fit).candidates, 36);
  EXPECT_DOUBLE_EQ(OfPeriod(bins, known, fit).period, 100.0 / 7);
  known.hold = 0;
  EXPECT_EQ(OfPeriod(bins, known, fit).candidates, 196);
  // too few holds for a wave
  known.hold = 50;
  EXPECT_EQ(OfPeriod(bins, known, fit).columns.cols(), 0);
}

TEST(Step, IsWhereTheFrictionOrTheTorqueSteps) {
  // 32 places of ten rows each: at the twentieth
  const Bins bins = EvenBins(320);
  const Eigen::VectorXd step = (bins.time.array() > 0.625).cast<double>();
  const Eigen::VectorXd turned = step.cwiseProduct(bins.velocity.cwiseSign());
  for (const Eigen::VectorXd& residual : {step, turned}) {
    const Features features = OfStep(bins, {}, Leaving(bins, residual));
    // 31 places between the parts, of each kind
    EXPECT_EQ(features.candidates, 62);
    ASSERT_EQ(features.columns.cols(), 1);
    EXPECT_EQ(features.columns.col(0), residual);
  }
}

TEST(HoldPhase, SeesWhatIsTheSameInBothHalvesOfAHold) {
  int seen = 0;
  for (std::uint64_t seed = 1; seed <= kLogs; ++seed) {
    const Estimate estimate = test::Answer("energy-ml", Swelling(1, seed));
    seen += test::Asked(estimate, "hold_phase").rejected ||
            test::Asked(estimate, "hold_parity").rejected;
  }
  EXPECT_EQ(seen, kLogs);
}

TEST(HoldPhase, LetsIntervalsHoldTheMeanThatNobodySees) {
  // 0.25 N.m shift coulomb by 0.16 N.m, more than two deviations, and count as a detail
  int answered = 0;
  for (std::uint64_t seed = 1; seed <= kLogs; ++seed) {
    const Estimate estimate = test::Answer("energy-ml", Swelling(0.25, seed));
    const bool found = test::Asked(estimate, "hold_phase").rejected ||
                       test::Asked(estimate, "hold_parity").rejected;
    if (estimate.status != Status::ok || !found) continue;
    ++answered;
    EXPECT_TRUE(Holds(estimate, "coulomb", 15)) << seed;
    EXPECT_TRUE(Holds(estimate, "thermal_gain", -3)) << seed;
  }
  EXPECT_GE(answered, kLogs / 2);
}

TEST(SpeedMemory, SeesFrictionThatFollowsTheSpeedLate) {
  int seen = 0;
  for (std::uint64_t seed = 1; seed <= kLogs; ++seed) {
    const Estimate estimate = test::Answer("energy-ml", Late(2, 200, seed));
    seen += test::Asked(estimate, "speed_memory").rejected;
  }
  // 80 % of 40 logs of the suite spoilt-logs: fewer than 11 of 20 come once in 400 times
  EXPECT_GE(seen, 11);
}

TEST(SpeedMemory, IsNotMadeWhereAHoldIsTooLongForTheLog) {
  Eigen::VectorXd velocity(600);
  for (Eigen::Index i = 0; i < 600; ++i) velocity[i] = i < 300 ? 0.5 : -0.8;
  const Estimate estimate =
      test::Answer("nominal-ls", test::RecordFriction(test::Cold(), 1, velocity, 0.5, 1));
  EXPECT_FALSE(test::Asked(estimate, "speed_memory").made);
}

}  // namespace
}  // namespace warmjoint
