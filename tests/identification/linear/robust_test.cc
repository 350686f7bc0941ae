#include <gmock/gmock.h>

#include <cmath>

#include "tests/support/judging.h"

namespace warmjoint {
namespace {

/// Table I with a share of its samples moved by N(0, 10^2) N.m.
Measurements Wild(std::uint64_t seed, double share) {
  Measurements m = test::RecordHour(test::TableOne(), seed);
  RandomStream random({seed, 0}, Stream::outliers);
  for (double& torque : m.torque) {
    if (random.Uniform() < share) torque += 10 * random.Normal();
  }
  return m;
}

Estimate Identify(const char* name, const Measurements& m, const char* loss) {
  return test::Fitted(name, m, {{"loss", loss}});
}

// 60 recordings with 5 % of wild samples: squares are off by 4.6 times the bound (0.05 x 400 of
// variance more), Huber's loss by 1.11 times (its asymptotic efficiency); an rms over 60 x 4 values
// is known to about 8 %
TEST(Huber, KeepsEnergyMlNearTheBoundAndItsIntervalsHonest) {
  double squares = 0, huber = 0;
  int held = 0, all = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Measurements m = Wild(seed, 0.05);
    const Estimate plain = Identify("energy-ml", m, "squares");
    const Estimate robust = Identify("energy-ml", m, "huber");
    ASSERT_EQ(robust.status, Status::ok) << robust.message;
    for (const auto& [name, truth] : test::TruthOf(test::TableOne())) {
      squares += std::pow((plain.Find(name)->value - truth) / truth, 2);
      huber += std::pow((robust.Find(name)->value - truth) / truth, 2);
      held += test::Holds(robust, name, truth);
      ++all;
    }
  }
  EXPECT_GT(std::sqrt(squares / 60), 3 * 0.0121);
  EXPECT_LT(std::sqrt(huber / 60), 1.11 * 1.25 * 0.0121);
  EXPECT_GT(held, 0.88 * all);  // parameters of a run err together: 60 values, not 240
}

TEST(Huber, SaysHowManySamplesAreWild) {
  const Estimate estimate = Identify("energy-ml", Wild(1, 0.01), "huber");
  EXPECT_THAT(estimate.message, ::testing::ContainsRegex("; [23][0-9] of 3600 samples lie more"));
}

TEST(Huber, LeavesExactDataAlone) {
  const Estimate estimate =
      Identify("energy-ml", test::RecordHour(test::TableOne(), 3, 0), "huber");
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  EXPECT_NEAR(estimate.Find("coulomb")->value, 15, 1e-5);
}

TEST(Huber, HoldsNominalLsToo) {
  Measurements m = test::RecordHour(test::Cold(), 4, 0.1);
  for (Eigen::Index i = 0; i < m.size(); i += 20) m.torque[i] = 100;
  const Estimate squares = Identify("nominal-ls", m, "squares");
  const Estimate huber = Identify("nominal-ls", m, "huber");
  ASSERT_EQ(huber.status, Status::ok) << huber.message;
  // one-sided outliers of 5 %: a bias of at most 0.05 / 0.95 bends (0.13 N.m) on the offset, which
  // viscous + coulomb see through the share of time that moves forwards; 0.03 N.m is seen
  EXPECT_NEAR(huber.Find("coulomb")->value, 15, 0.05);
  EXPECT_GT(std::abs(squares.Find("coulomb")->value - 15), 0.05);
}

}  // namespace
}  // namespace warmjoint
