#include "sim/plant/sampling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace warmjoint {
namespace {

RandomStream Random() { return {{3, 0}, Stream::test}; }

/// The samples of a signal f(t), t in s.
template <typename F>
Eigen::VectorXd Log(const Sampling& sampling, double noise, Eigen::Index stored, F signal) {
  LoggedSignal log(sampling, noise, Random(), stored);
  for (Eigen::Index j = 0; j < SensorReadings(sampling, stored); ++j) {
    log.Read(signal(static_cast<double>(j) / sampling.sensor_rate));
  }
  return log.samples();
}

/// Mean of |H|^2 of the low-pass over all frequencies: the variance that white noise keeps. The
/// trapezoid rule on a smooth periodic function converges beyond rounding.
double MeanSquaredGain(double cutoff, double rate) {
  const int points = 20000;
  double sum = 0;
  for (int i = 0; i < points; ++i) {
    const double ratio = std::tan(std::numbers::pi * (i + 0.5) / points) /
                         std::tan(std::numbers::pi * cutoff / rate);
    sum += 1 / (1 + std::pow(ratio, 2 * kSensorFilterOrder));
  }
  return sum / points;
}

TEST(Sampling, StoresReadingsOrTheLineBetweenTwo) {
  const auto every = Log({10, 10, 0}, 0, 5, [](double t) { return std::exp(t); });
  for (int k = 0; k < 5; ++k) EXPECT_EQ(every[k], std::exp(k / 10.0));
  EXPECT_EQ(SensorReadings({50, 250, 0}, 11), 51);
  const auto fifth = Log({50, 250, 0}, 0, 11, [](double t) { return t * t; });
  for (int k = 0; k < 11; ++k) EXPECT_NEAR(fifth[k], k * k / 2500.0, 1e-15);
  // 250 Hz stored at 20 Hz: every second sample lies midway between two readings
  EXPECT_EQ(SensorReadings({20, 250, 0}, 2), 14);
  const auto line = Log({20, 250, 0}, 0, 100, [](double t) { return 3 - 2 * t; });
  for (int k = 0; k < 100; ++k) EXPECT_NEAR(line[k], 3 - 2 * k / 20.0, 1e-13);
}

TEST(Sampling, KeepsAConstantThroughTheFilterFromTheFirstSampleOn) {
  const auto samples = Log({20, 250, 10}, 0, 100, [](double) { return 7.0; });
  for (double sample : samples) EXPECT_NEAR(sample, 7, 1e-12);
}

TEST(Sampling, TakesOutWhatIsAboveTheCutoff) {
  // |H| at 50 Hz with a 5 Hz corner: (tan(pi/5) / tan(pi/50))^-4 = 5.6e-5
  const auto samples =
      Log({250, 250, 5}, 0, 2000, [](double t) { return std::sin(2 * std::numbers::pi * 50 * t); });
  EXPECT_LT(samples.tail(1000).lpNorm<Eigen::Infinity>(), 6e-5);
  EXPECT_GT(samples.tail(1000).lpNorm<Eigen::Infinity>(), 5e-5);
}

TEST(Sampling, KnowsTheNoiseThatTheFilterLeaves) {
  EXPECT_EQ(NoiseLeft({50, 250, 0}, 100), 1);
  for (double cutoff : {1.0, 10.0, 60.0}) {
    EXPECT_NEAR(NoiseLeft({50, 250, cutoff}, 100), std::sqrt(MeanSquaredGain(cutoff, 250)), 1e-9);
  }
}

TEST(Sampling, KnowsTheNoiseLeftMidwayBetweenReadings) {
  // half of the samples on a reading (variance 1), half midway (variance 1/2)
  EXPECT_NEAR(NoiseLeft({20, 250, 0}, 100), std::sqrt(0.75), 1e-15);
}

TEST(Sampling, LeavesTheNoiseThatItSays) {
  // stored every 0.1 s, noise of a 20 Hz low-pass is as good as independent; sd of a variance from
  // n samples: sqrt(2 / n); bound 5 sd
  const Sampling sampling{10, 250, 20};
  const Eigen::Index n = 4000;
  const auto samples = Log(sampling, 2, n, [](double) { return 0.0; });
  const double expected = 2 * NoiseLeft(sampling, n);
  EXPECT_NEAR(samples.squaredNorm() / double(n) / (expected * expected), 1,
              5 * std::sqrt(2.0 / double(n)));
}

}  // namespace
}  // namespace warmjoint
