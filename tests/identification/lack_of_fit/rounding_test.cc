#include "identification/lack_of_fit/rounding.h"

#include <gtest/gtest.h>

#include <cmath>

#include "models/foundation/random_stream.h"
#include "tests/support/judging.h"

namespace warmjoint {
namespace {

constexpr double kNoise = 0.5;  // N.m

double Rounded(double torque, double step, double offset) {
  return step * std::round((torque - offset) / step) + offset;
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
