#include "models/foundation/low_pass.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace warmjoint {
namespace {

TEST(LowPass, IsSettledOnTheFirstSampleAndFollowsAStepByTheExponential) {
  const Eigen::VectorXd time = Eigen::Vector4d(0, 0.1, 0.3, 1);
  const Eigen::VectorXd x = Eigen::Vector4d(-3, 1, 1, 1);
  const Eigen::VectorXd y = LowPass(time, x, 0.2);
  EXPECT_EQ(y[0], -3);
  EXPECT_EQ(y[1], -3) << "the step drives from its own sample on";
  EXPECT_NEAR(y[2], 1 - 4 * std::exp(-0.2 / 0.2), 1e-15);
  EXPECT_NEAR(y[3], 1 - 4 * std::exp(-0.9 / 0.2), 1e-15);
}

constexpr double kPi = std::numbers::pi;

double Gain(const std::vector<Biquad>& sections, double frequency, double rate) {
  const std::complex<double> z = std::polar(1.0, -2 * kPi * frequency / rate);  // one step of delay
  std::complex<double> gain = 1;
  for (const Biquad& s : sections) {
    gain *= (s.b0 + z * (s.b1 + z * s.b2)) / (1.0 + z * (s.a1 + z * s.a2));
  }
  return std::abs(gain);
}

TEST(ButterworthLowPass, HasTheGainOfItsFormula) {
  for (const int order : {2, 4, 6}) {
    const std::vector<Biquad> sections = ButterworthLowPass(order, 100, 1000);
    for (const double frequency : {0.0, 1.0, 50.0, 100.0, 200.0, 400.0}) {
      const double ratio = std::tan(kPi * frequency / 1000) / std::tan(kPi * 100 / 1000);
      const double expected = 1 / std::sqrt(1 + std::pow(ratio, 2 * order));
      // closed form; the sums of the sections cancel to about 1e-13 of the pass band
      EXPECT_NEAR(Gain(sections, frequency, 1000), expected, 1e-12) << order << " " << frequency;
    }
  }
}

TEST(BiquadCascade, KeepsAConstantOnceSettled) {
  BiquadCascade filter(ButterworthLowPass(4, 8, 250));
  filter.Settle(3);
  for (int i = 0; i < 1000; ++i) EXPECT_NEAR(filter.Step(3), 3, 1e-12);
}

TEST(FilterZeroPhase, SquaresTheGainAndLeavesThePhase) {
  constexpr int n = 4000;
  constexpr double rate = 1000, frequency = 80;
  const std::vector<Biquad> sections = ButterworthLowPass(4, 100, rate);
  Eigen::VectorXd x(n);
  for (int i = 0; i < n; ++i) x[i] = std::sin(2 * kPi * frequency * i / rate + 0.3);
  const Eigen::VectorXd y = FilterZeroPhase(sections, x);

  const double gain = Gain(sections, frequency, rate);
  // away from the ends, whose transients have died out to rounding
  const auto error = (y - gain * gain * x).segment(500, n - 1000);
  EXPECT_LT(error.cwiseAbs().maxCoeff(), 1e-12);
}

TEST(FilterZeroPhase, KeepsStraightLinesToTheirEnds) {
  const Eigen::VectorXd line = Eigen::VectorXd::LinSpaced(601, -1, 11);
  const Eigen::VectorXd y = FilterZeroPhase(ButterworthLowPass(4, 30, 1000), line);
  EXPECT_LT((y - line).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(FilterZeroPhase, TakesFewSamples) {
  const std::vector<Biquad> sections = ButterworthLowPass(4, 10, 1000);
  for (int n = 1; n < 6; ++n) {
    EXPECT_EQ(FilterZeroPhase(sections, Eigen::VectorXd::Zero(n)), Eigen::VectorXd::Zero(n));
  }
}

}  // namespace
}  // namespace warmjoint
