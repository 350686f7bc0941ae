// Figures of kernels, envelopes and predictions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "identification/alternating/first_guess.h"
#include "tests/tools/figures/look.h"
#include "tests/tools/figures/warm_recording.h"
#include "tools/figures/estimate_figures.h"

namespace warmjoint::figures {
namespace {

using ::testing::HasSubstr;

TEST(Envelope, ShowsTheLevelAndWhereTheGuessIsRead) {
  const WarmRecording warm;
  const FirstGuess guess = GuessThermal(warm.measurements, warm.selection);
  ASSERT_TRUE(guess.thermal) << guess.why;
  const TorqueEnvelope& envelope = *guess.envelope;
  const Figure figure = *MakeEnvelope("warm", warm.measurements, warm.selection, Thermal{-3, 600});
  const Shown drawn = Look(figure);

  const ShownPlot& torque = PlotNamed(drawn, "The recording and its level of friction");
  EXPECT_EQ(SeriesNamed(torque, "level of friction").y.second, envelope.level.maxCoeff());
  EXPECT_NEAR(SeriesNamed(torque, "torque").y.second, warm.measurements.torque.maxCoeff(), 1e-12);
  EXPECT_NEAR(SeriesNamed(torque, "torque").x.second, 20, 0.1) << "minutes";

  const ShownPlot& level = PlotNamed(drawn, "What the guess is read off");
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

TEST(Kernels, OfThePlainKindFallToZeroBeyondTheDataAndNormalisedOnesDoNot) {
  const Figure figure = MakeKernels();
  const Shown drawn = Look(figure);
  const Plot& fits = std::get<Plot>(figure.panels[0].content);
  const auto line = [&](std::size_t i) { return std::get<Line>(fits.series[i].shape); };
  const Line truth = line(0), plain = line(2), normalised = line(3);
  const Eigen::Index last = truth.x.size() - 1, edge = 3 * last / 4, middle = last / 2;
  EXPECT_EQ(truth.x[edge], 2);
  // noise of 0.05 on 60 samples for 6 kernels: 0.016, four times; and the kernels' spacing of 0.8
  // cuts the parabola's corners by 0.6 * 0.8^2 / 8 = 0.048. At the edge the plain ones already fall
  constexpr double kClose = 4 * 0.016 + 0.048;
  for (const Line& fit : {plain, normalised}) {
    EXPECT_NEAR(fit.y[middle], -0.5, kClose);
    const Eigen::Index inside = 7 * last / 10;  // t = 1.6, half a spacing from the edge
    EXPECT_NEAR(fit.y[inside], truth.y[inside], kClose);
  }
  EXPECT_NEAR(normalised.y[edge], truth.y[edge], kClose);
  EXPECT_LT(std::abs(plain.y[last]), 0.2 * truth.y[edge]);
  EXPECT_GT(normalised.y[last], 0.9 * truth.y[edge]);

  // and that is what is drawn, in its colours
  const ShownPlot& plot = drawn.plots[0];
  EXPECT_EQ(SeriesNamed(plot, "plain kernels").hue, Hue::orange);
  EXPECT_EQ(drawn.plots[1].series.size(), 6u);
  // two widths and a half beyond the last centre only the kernel before it still counts: 5 %
  EXPECT_NEAR(drawn.plots[2].series[5].y.second, 0.95, 0.01) << "the outermost keeps its value";
}

TEST(Predicted, SaysHowFarPredictionAndMeasurementDiffer) {
  const WarmRecording warm;
  const Figure figure = *MakePredicted(warm.View());
  const Shown drawn = Look(figure);
  EXPECT_EQ(drawn.plots[0].x, drawn.plots[0].y) << "one scale: equal lies on the diagonal";
  // noise of 0.5 over 1200 samples: known to 2 %
  EXPECT_THAT(figure.finding, HasSubstr("differ by 0.5"));
  EXPECT_FALSE(MakePredicted(MakeFitView(warm.measurements, warm.selection, {})));
}

TEST(LogFigure, ShowsTheRecordingWithItsKeptSamples) {
  WarmRecording warm;
  warm.selection.keep.head(600).setConstant(false);
  const Figure figure = MakeLogFigure(MakeFitView(warm.measurements, warm.selection, {}));
  const Shown drawn = Look(figure);
  ASSERT_EQ(drawn.plots.size(), 3u);
  EXPECT_NEAR(SeriesNamed(drawn.plots[0], "kept for the fit").x.first, 10, 0.01) << "minutes";
  EXPECT_NEAR(SeriesNamed(drawn.plots[0], "all samples").x.first, 0, 0.01);
  EXPECT_THAT(figure.finding, HasSubstr("Of 1200 samples 50 % are kept"));
}

}  // namespace
}  // namespace warmjoint::figures
