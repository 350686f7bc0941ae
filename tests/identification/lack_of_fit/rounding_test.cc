#include "identification/lack_of_fit/rounding.h"

#include <gtest/gtest.h>

#include <cmath>

#include "models/foundation/random_stream.h"
#include "tests/support/judging.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kNoise = 0.5;  // N.m

double Rounded(double torque, double step, double offset) {
  return step * std::round((torque - offset) / step) + offset;
}

TEST(Rounding, IsTheMeanErrorOfWhatIsLogged) {
  for (const double step : {0.8, 1.5, 3.0}) {
    constexpr double offset = 0.3;  // N.m, of the sensor's steps
    constexpr Index levels = 40, each = 20'000;
    RandomStream random({2, 7}, Stream::test);
    VectorXd torque(levels * each), level(levels * each);
    for (Index i = 0; i < torque.size(); ++i) {
      level[i] = 5 + 0.1 * static_cast<double>(i % levels);
      torque[i] = Rounded(level[i] + kNoise * random.Normal(), step, offset);
    }
    const VectorXd residual = torque - level;
    const VectorXd mean =
        MeanRounding(torque, residual, residual.squaredNorm() / static_cast<double>(torque.size()));
    ASSERT_EQ(mean.size(), torque.size());

    // 5 standard errors of the mean over each level's samples; the noise is known to 1 % where steps are small
    const double scatter = std::hypot(kNoise, step / std::sqrt(12.0));
    for (Index k = 0; k < levels; ++k) {
      double sum = 0;
      for (Index i = k; i < torque.size(); i += levels) sum += residual[i];
      EXPECT_NEAR(mean[k], sum / each, 5 * scatter / std::sqrt(each) + 0.01 * step)
          << step << " at " << level[k];
    }
  }
}

TEST(Rounding, IsNoMatterWhereNoiseEvensItOut) {
  RandomStream random({3, 7}, Stream::test);
  VectorXd residual(1000), torque(1000);
  for (Index i = 0; i < 1000; ++i) {
    residual[i] = kNoise * random.Normal();
    torque[i] = 5 + residual[i];
  }
  EXPECT_EQ(MeanRounding(torque, residual, kNoise * kNoise).size(), 0);
  for (double& t : torque) t = Rounded(t, 0.4, 0);
  EXPECT_EQ(MeanRounding(torque, residual, kNoise * kNoise).size(), 0);
}

TEST(Rounding, IsTakenBackFromTheParameters) {
  int answers = 0, held = 0, warned = 0;
  double errors = 0, variances = 0;
  constexpr int logs = 30;
  for (std::uint64_t seed = 1; seed <= logs; ++seed) {
    Measurements log = test::RecordHour(test::TableOne(), seed);
    for (double& t : log.torque) t = Rounded(t, 5 * kNoise, 0);
    const Estimate estimate = test::Answer("energy-ml", log);
    const EstimatedParameter& viscous = *estimate.Find("viscous");
    if (!viscous.interval95) continue;
    ++answers;
    const auto [lower, upper] = *viscous.interval95;
    held += lower <= 5 && 5 <= upper;
    errors += viscous.value - 5;
    variances += *viscous.std * *viscous.std;
    EXPECT_EQ(viscous.value, estimate.friction->parameters.at("viscous")) << seed;
    warned += estimate.FullMessage().find("comes in steps of 2.5") != std::string::npos;
  }
  // 95 % of 30: 24 or fewer with a probability of 0.3 %; a refusal does not hold
  EXPECT_GE(held, 25);
  // no mean error: 4 of its standard errors
  EXPECT_LT(std::abs(errors), 4 * std::sqrt(variances));
  EXPECT_GE(answers, 27);
  EXPECT_GT(warned, 0);
}

}  // namespace
}  // namespace warmjoint
