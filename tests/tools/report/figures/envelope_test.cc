#include "tools/report/figures/envelope.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "identification/alternating/first_guess.h"
#include "tests/tools/report/look.h"
#include "tests/tools/report/warm_recording.h"

namespace warmjoint::report {
namespace {

using ::testing::HasSubstr;

TEST(Envelope, ShowsTheLevelAndWhereTheGuessIsRead) {
  const WarmRecording warm;
  const FirstGuess guess = GuessThermal(warm.measurements, warm.selection);
  ASSERT_TRUE(guess.thermal) << guess.why;
  const TorqueEnvelope& envelope = *guess.envelope;
  const Figure figure = *MakeEnvelope("warm", warm.measurements, warm.selection, Thermal{-3, 600});
  const Drawn drawn = DrawLight(figure);

  const DrawnPlot& torque = PlotNamed(drawn, "The recording and its level of friction");
  EXPECT_EQ(SeriesNamed(torque, "level of friction").y.second, envelope.level.maxCoeff());
  EXPECT_NEAR(SeriesNamed(torque, "torque").y.second, warm.measurements.torque.maxCoeff(), 1e-12);
  EXPECT_NEAR(SeriesNamed(torque, "torque").x.second, 20, 0.1) << "minutes";

  const DrawnPlot& level = PlotNamed(drawn, "What the guess is read off");
  EXPECT_EQ(SeriesNamed(level, "cold").y, std::pair(envelope.cold, envelope.cold));
  EXPECT_NEAR(SeriesNamed(level, "63 % of the way").x.second, envelope.time_to_63 / 60, 1e-12);
  EXPECT_EQ(SeriesNamed(level, "settled: mean of the last quarter").y.first, envelope.settled);
  EXPECT_THAT(figure.subtitle, HasSubstr("truth: k = −3.00 N·m/W, τ = 600 s"));
}

TEST(Envelope, IsNothingWhereNothingWarms) {
  WarmRecording warm;
  warm.measurements.torque =
      5 * warm.measurements.velocity.array() + 15 * warm.measurements.velocity.array().sign();
  RandomStream random({9, 0}, Stream::test);
  for (double& torque : warm.measurements.torque) torque += 0.5 * random.Normal();
  EXPECT_FALSE(MakeEnvelope("cold", warm.measurements, warm.selection, std::nullopt));
}

}  // namespace
}  // namespace warmjoint::report
