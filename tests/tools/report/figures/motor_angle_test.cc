#include "tools/report/figures/motor_angle.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/report/look.h"
#include "tests/tools/report/mapped_recording.h"
#include "tools/report/draw/draw_series.h"
#include "tools/report/figures/friction_map.h"

namespace warmjoint::report {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(MotorAngle, ShowsTheRippleOfEachSpeedInEachDirection) {
  const MappedRecording mapped;
  const Drawn drawn = DrawLight(*MakeMotorAngle(mapped.View()));
  const DrawnPlot& forwards = PlotNamed(drawn, "Forwards");
  EXPECT_EQ(forwards.x, std::pair(0.0, 2 * M_PI));
  // 15 + 5 v, a wave of 2 about it, and 0.1 of noise: a bin of a sixteenth turn misses the crest by
  // 2 % of the wave, its mean of 8 samples or more by 0.1
  const DrawnSeries& slow = SeriesNamed(forwards, "0.2 rad/s");
  EXPECT_NEAR(slow.y.first, 16 - 2, 0.15);
  EXPECT_NEAR(slow.y.second, 16 + 2, 0.15);
  EXPECT_EQ(slow.colour, LightTheme().Colour(Hue::blue));
  const DrawnSeries& fast = SeriesNamed(forwards, "0.9 rad/s");
  EXPECT_NEAR(fast.y.second, 19.5 + 2, 0.15);
  const DrawnPlot& backwards = PlotNamed(drawn, "Backwards");
  EXPECT_NEAR(SeriesNamed(backwards, "0.9 rad/s").y.first, -19.5 - 2, 0.15);
}

TEST(MotorAngle, IsNothingWithoutAMotorAngle) {
  const WarmRecording warm;
  const FitView view = MakeFitView(warm.measurements, warm.selection, warm.estimate);
  EXPECT_FALSE(MakeMotorAngle(view));
  EXPECT_FALSE(MakeMotorMap(view));
  EXPECT_FALSE(MakeMotorFit(view));
  EXPECT_FALSE(MakeFrictionMap(view));
}

TEST(MotorMap, ShowsTheMapOverTheTorqueThatItExplains) {
  const MappedRecording mapped;
  const Figure figure = *MakeMotorMap(mapped.View());
  const Drawn drawn = DrawLight(figure);
  const DrawnPlot& forwards = PlotNamed(drawn, "Forwards: torque less law and warming");
  // kernels one spacing of 10 degrees wide lose 1 - exp(-(10 deg)^2 / 2) = 1.5 % of a wave
  EXPECT_NEAR(SeriesNamed(forwards, "map at 0.5 rad/s").y.second, 2, 0.04);
  EXPECT_NEAR(SeriesNamed(forwards, "map at 0.5 rad/s").y.first, -2, 0.04);
  // an RMS of 2/sqrt(2) without the map, of the noise with it
  EXPECT_THAT(figure.finding, StartsWith("The map over motor angle takes the RMSE from 1."));
  EXPECT_THAT(figure.finding, HasSubstr("to 0.10"));
}

TEST(MotorFit, FollowsTheSamplesWithTheMapAndStaysAtTheirMiddleWithoutIt) {
  const MappedRecording mapped;
  const Drawn drawn = DrawLight(*MakeMotorFit(mapped.View()));
  const DrawnPlot& cold = PlotNamed(drawn, "Cold: in the first slow segment");
  const DrawnSeries& measured = SeriesNamed(cold, "measured");
  const DrawnSeries& with = SeriesNamed(cold, "with it");
  const DrawnSeries& without = SeriesNamed(cold, "fit without the map");
  // noise of 0.1: twenty samples stay within four deviations
  EXPECT_NEAR(with.y.second - with.y.first, measured.y.second - measured.y.first, 0.8);
  EXPECT_LT(without.y.second - without.y.first, 0.5 * (with.y.second - with.y.first));
}

TEST(FrictionMap, IsAHeatMapOfEachDirectionColdAndWarmOnOneScale) {
  const MappedRecording mapped;
  const FitView view = mapped.View();
  const Figure figure = *MakeFrictionMap(view);
  const Drawn drawn = DrawLight(figure);
  ASSERT_EQ(drawn.plots.size(), 4u);
  const DrawnPlot& cold = PlotNamed(drawn, "Forwards, cold");
  EXPECT_EQ(cold.x, std::pair(0.0, 2 * M_PI));
  EXPECT_EQ(cold.y, std::pair(0.0, 0.9));
  const DrawnPlot& back = PlotNamed(drawn, "Backwards, cold");
  EXPECT_EQ(back.y, std::pair(-0.9, 0.0));

  // the coldest, fastest, highest ripple is the end of the scale; ripple and sign(v) multiply
  const HeatMap& map = std::get<HeatMap>(std::get<Plot>(figure.panels[0].content).series[0].shape);
  EXPECT_NEAR(map.colours.second, 15 + 5 * 0.9 + 2, 0.1);
  EXPECT_EQ(map.colours,
            std::get<HeatMap>(std::get<Plot>(figure.panels[1].content).series[0].shape).colours);
  const auto colour_at = [&](const DrawnPlot& plot, double angle, double v) {
    const Pixel at = PixelOf(plot, angle, v);
    return drawn.image.At(at.x, at.y);
  };
  const auto expected = [&](double value) {
    return HeatColour((value - map.colours.first) / (map.colours.second - map.colours.first));
  };
  // a cell is a sixtieth of the axes: 0.1 of velocity and angle change friction by 0.2 of some 18
  EXPECT_LT(Distance(colour_at(cold, M_PI / 2, 0.6), expected(15 + 3 + 2)), 12);
  EXPECT_LT(Distance(colour_at(cold, 3 * M_PI / 2, 0.6), expected(15 + 3 - 2)), 12);
  const HeatMap& mirrored =
      std::get<HeatMap>(std::get<Plot>(figure.panels[2].content).series[0].shape);
  const double share =
      (15 + 3 - 2 - mirrored.colours.first) / (mirrored.colours.second - mirrored.colours.first);
  EXPECT_LT(Distance(colour_at(back, M_PI / 2, -0.6), HeatColour(share)), 12) << "not swapped";
  EXPECT_EQ(colour_at(cold, M_PI, 0.05), LightTheme().background) << "never so slow";
  const DrawnPlot& warm = drawn.plots[1];
  EXPECT_LT(Distance(colour_at(warm, M_PI / 2, 0.6), expected(15 + 3 + 2 + WarmestEnergy(view))),
            12);
}

TEST(FrictionMap, LeavesAHoleWithoutSamplesBlankAndDrawsTheSamples) {
  MappedRecording mapped;
  // nothing is kept in the second quarter of the turn, forwards
  const Eigen::VectorXd angle = mapped.View().motor_angle;
  for (Eigen::Index i = 0; i < angle.size(); ++i) {
    const bool hole = angle[i] > M_PI / 2 && angle[i] < M_PI;
    if (hole && mapped.measurements.velocity[i] > 0) mapped.selection.keep[i] = false;
  }
  const Drawn drawn = DrawLight(*MakeFrictionMap(mapped.View()));
  const auto colour_at = [&](const std::string& title, double x, double v) {
    const Pixel at = PixelOf(PlotNamed(drawn, title), x, v);
    return drawn.image.At(at.x, at.y);
  };
  EXPECT_EQ(colour_at("Forwards, cold", 0.75 * M_PI, 0.55), LightTheme().background);
  EXPECT_NE(colour_at("Backwards, cold", 0.75 * M_PI, -0.55), LightTheme().background);
  EXPECT_GT(SeriesNamed(PlotNamed(drawn, "Forwards, cold"), "samples").points, 100);
}

}  // namespace
}  // namespace warmjoint::report
