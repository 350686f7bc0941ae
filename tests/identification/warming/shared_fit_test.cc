// Logs that share unknowns: two joints with one gravity and frictions of their own, two recordings of one joint.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "identification/linear/linear_laws.h"
#include "identification/warming/thermal_fit.h"
#include "tests/support/vectors.h"
#include "tests/support/warm_recording.h"

namespace warmjoint {
namespace {

using Eigen::VectorXd;

constexpr double kGravity = 8;  // N.m at a quarter turn

/// A joint's log with g sin(p) beside its friction, and its rows.
struct Joint {
  LogSamples log;
  ClosedLoop loop;
  VectorXd level, weight;
  Eigen::MatrixXd offsets;

  Joint(const Friction& friction, std::uint64_t seed, double noise)
      : Joint(LogSamples(Recorded(friction, seed, noise))) {}
  /// A log of a law with a viscous and a Coulomb part.
  explicit Joint(LogSamples samples)
      : log(std::move(samples)),
        loop(ClosedLoop::Along(log, LawColumns(*FindLaw("viscous_coulomb"), log.velocity))),
        level(loop.direction().cwiseProduct(log.torque)),
        weight(VectorXd::Ones(log.size())),
        offsets(loop.direction().cwiseProduct(log.position.array().sin().matrix())) {}

  static Measurements Recorded(const Friction& friction, std::uint64_t seed, double noise) {
    Measurements m =
        test::RecordFriction(friction, 1, test::AlternatingSpeeds(2400, seed), noise, seed);
    for (Eigen::Index i = 1; i < m.size(); ++i) {
      m.position[i] = m.position[i - 1] + 0.1 * m.velocity[i - 1];
    }
    m.torque += kGravity * m.position.array().sin().matrix();
    return m;
  }

  ThermalRows Rows(double scale) const {
    return {.loop = loop, .level = level, .offsets = offsets, .weight = weight, .scale = scale};
  }
};

const Friction kOther{"viscous_coulomb", {{"viscous", 9}, {"coulomb", 4}}, Thermal{-1, 400}, 0, 1};

/// viscous, coulomb, gain and log(tau) of each joint, then the gravity that both have.
const std::vector<Eigen::Index> kFirst{0, 1, 2, 3, 8}, kSecond{4, 5, 6, 7, 8};

SharedFit Together(const Joint& one, const Joint& other, const std::array<double, 2>& noise) {
  const std::vector<SharedRows> logs{{one.Rows(noise[0]), kFirst}, {other.Rows(noise[1]), kSecond}};
  VectorXd start(9);
  start << 4, 10, -2, std::log(500), 6, 6, -0.5, std::log(500), 0;
  return FitTogether(logs, start);
}

TEST(SharedFit, OfExactLogsFindsBothFrictionsAndTheirGravity) {
  const SharedFit fit = Together(Joint(test::TableOne(), 1, 0), Joint(kOther, 2, 0), {1, 1});
  ASSERT_TRUE(fit.converged);
  const std::array<double, 9> truth{5, 15, -3, std::log(600), 9, 4, -1, std::log(400), kGravity};
  for (Eigen::Index i = 0; i < 9; ++i)
    EXPECT_NEAR(fit.x[i], truth[static_cast<size_t>(i)], 1e-6) << i;
}

TEST(SharedFit, WeighsEachLogsGravityByItsInformation) {
  const std::array<double, 2> noise{0.5, 1.5};  // N.m
  const Joint one(test::TableOne(), 3, noise[0]), other(kOther, 4, noise[1]);
  const SharedFit both = Together(one, other, noise);
  ASSERT_TRUE(both.converged);

  // of gravity each log alone tells v; together 1 / v adds up, and the estimate is their weighted mean: what is left of
  // the normal equations where each joint's own unknowns are eliminated. The loop bends by a thousandth within the noise
  double information = 0, mean = 0;
  for (const auto& [joint, scale] : {std::pair(&one, noise[0]), std::pair(&other, noise[1])}) {
    const InitialGuess start{Eigen::Vector3d(5, 10, 0), {-1.5, 500}, 0, 0};
    const ThermalFit alone = FitThermalFriction(joint->Rows(scale), start);
    ASSERT_TRUE(alone.converged);
    const double variance = std::pow(alone.Deviation(alone.layout.rigid.begin, scale * scale), 2);
    information += 1 / variance;
    mean += alone.rigid()[0] / variance;
  }
  const double deviation = 1 / std::sqrt(information);
  EXPECT_NEAR(std::sqrt(both.cofactor(8, 8)), deviation, 1e-3 * deviation);
  EXPECT_NEAR(both.x[8], mean / information, 0.02 * deviation);
  EXPECT_NEAR(both.x[8], kGravity, 4 * deviation);
}

TEST(SharedFit, OfTwoRecordingsIsTheFitOfTheirStack) {
  const double noise = 0.5;  // N.m
  const Joint one(test::TableOne(), 5, noise), other(test::TableOne(), 6, noise);
  const Joint stack(Join({Prepare(one.log), Prepare(other.log)}).raw().measurements);
  const InitialGuess guess{Eigen::Vector3d(5, 10, 0), {-1.5, 500}, 0, 0};

  // the start of the second recording as an unknown jump of E
  const ClosedLoop loop = stack.loop.WithJumps({one.log.size()});
  ThermalRows rows = stack.Rows(noise).Along(loop);
  rows.initial = InitialEnergy::estimated;
  rows.jump_spread = VectorXd::Constant(1, std::numeric_limits<double>::infinity());
  const ThermalFit stacked = FitThermalFriction(rows, guess);
  ASSERT_TRUE(stacked.converged);

  // as a list: viscous, coulomb, gain, log(tau), E(0) of each recording, gravity
  std::vector<SharedRows> list{{one.Rows(noise), {0, 1, 2, 3, 4, 6}},
                               {other.Rows(noise), {0, 1, 2, 3, 5, 6}}};
  for (SharedRows& log : list) log.rows.initial = InitialEnergy::estimated;
  VectorXd start = VectorXd::Zero(7);
  start.head(4) << 5, 10, -1.5, std::log(500);
  const SharedFit shared = FitTogether(list, start);
  ASSERT_TRUE(shared.converged);

  // both know each unknown equally well, and where it is to a millionth of that
  for (Eigen::Index i = 0; i < 7; ++i) {
    const double deviation = stacked.Deviation(i, noise * noise);
    EXPECT_NEAR(std::sqrt(shared.cofactor(i, i)), deviation, 1e-6 * deviation) << i;
    EXPECT_NEAR(shared.x[i], stacked.x[i], 1e-6 * deviation) << i;
  }
}

}  // namespace
}  // namespace warmjoint
