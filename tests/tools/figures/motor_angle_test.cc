#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/figures/look.h"
#include "tests/tools/figures/warm_recording.h"
#include "tools/figures/estimate_figures.h"

namespace warmjoint::figures {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(MotorAngle, ShowsTheRippleOfEachSpeedInEachDirection) {
  const MappedRecording mapped;
  const Shown drawn = Look(*MakeMotorAngle(mapped.View()));
  const ShownPlot& forwards = PlotNamed(drawn, "Forwards");
  EXPECT_EQ(forwards.x, std::pair(0.0, 2 * M_PI));
  // 15 + 5 v, a wave of 2 about it, and 0.1 of noise: a bin of a sixteenth turn misses the crest by
  // 2 % of the wave, its mean of 8 samples or more by 0.1
  const ShownSeries& slow = SeriesNamed(forwards, "0.2 rad/s");
  EXPECT_NEAR(slow.y.first, 16 - 2, 0.15);
  EXPECT_NEAR(slow.y.second, 16 + 2, 0.15);
  EXPECT_EQ(slow.hue, Hue::blue);
  const ShownSeries& fast = SeriesNamed(forwards, "0.9 rad/s");
  EXPECT_NEAR(fast.y.second, 19.5 + 2, 0.15);
  const ShownPlot& backwards = PlotNamed(drawn, "Backwards");
  EXPECT_NEAR(SeriesNamed(backwards, "0.9 rad/s").y.first, -19.5 - 2, 0.15);
}

TEST(MotorAngle, IsNothingWithoutAMotorAngle) {
  const WarmRecording warm;
  const FitView view = warm.View();
  EXPECT_FALSE(MakeMotorAngle(view));
  EXPECT_FALSE(MakeMotorMap(view));
  EXPECT_FALSE(MakeMotorFit(view));
  EXPECT_FALSE(MakeFrictionMap(view));
}

TEST(MotorMap, ShowsTheMapOverTheTorqueThatItExplains) {
  const MappedRecording mapped;
  const Figure figure = *MakeMotorMap(mapped.View());
  const Shown drawn = Look(figure);
  const ShownPlot& forwards = PlotNamed(drawn, "Forwards: torque less law and warming");
  // kernels one spacing of 10 degrees wide lose 1 - exp(-(10 deg)^2 / 2) = 1.5 % of a wave
  EXPECT_NEAR(SeriesNamed(forwards, "map at 0.5 rad/s").y.second, 2, 0.04);
  EXPECT_NEAR(SeriesNamed(forwards, "map at 0.5 rad/s").y.first, -2, 0.04);
  // an RMS of 2/sqrt(2) without the map, of the noise with it
  EXPECT_THAT(figure.finding, StartsWith("The map over motor angle takes the RMSE from 1."));
  EXPECT_THAT(figure.finding, HasSubstr("to 0.10"));
}

TEST(MotorFit, FollowsTheSamplesWithTheMapAndStaysAtTheirMiddleWithoutIt) {
  const MappedRecording mapped;
  const Shown drawn = Look(*MakeMotorFit(mapped.View()));
  const ShownPlot& cold = PlotNamed(drawn, "Cold: in the first slow segment");
  const ShownSeries& measured = SeriesNamed(cold, "measured");
  const ShownSeries& with = SeriesNamed(cold, "with it");
  const ShownSeries& without = SeriesNamed(cold, "fit without the map");
  // noise of 0.1: twenty samples stay within four deviations
  EXPECT_NEAR(with.y.second - with.y.first, measured.y.second - measured.y.first, 0.8);
  EXPECT_LT(without.y.second - without.y.first, 0.5 * (with.y.second - with.y.first));
}

const HeatMap& MapOf(const Figure& figure, std::size_t panel) {
  return std::get<HeatMap>(std::get<Plot>(figure.panels.at(panel).content).series[0].shape);
}

/// Of the cell that holds the place.
double ValueAt(const HeatMap& map, double x, double y) {
  const auto cell = [](double value, const std::pair<double, double>& range, Eigen::Index count) {
    const double share = (value - range.first) / (range.second - range.first);
    return static_cast<Eigen::Index>(share * static_cast<double>(count));
  };
  return map.values(cell(y, map.y, map.values.rows()), cell(x, map.x, map.values.cols()));
}

TEST(FrictionMap, IsAHeatMapOfEachDirectionColdAndWarmOnOneScale) {
  const MappedRecording mapped;
  const FitView view = mapped.View();
  const Figure figure = *MakeFrictionMap(view);
  const Shown drawn = Look(figure);
  ASSERT_EQ(drawn.plots.size(), 4u);
  const ShownPlot& cold = PlotNamed(drawn, "Forwards, cold");
  EXPECT_EQ(cold.x, std::pair(0.0, 2 * M_PI));
  EXPECT_EQ(cold.y, std::pair(0.0, 0.9));
  const ShownPlot& back = PlotNamed(drawn, "Backwards, cold");
  EXPECT_EQ(back.y, std::pair(-0.9, 0.0));

  // the coldest, fastest, highest ripple is the end of the scale; ripple and sign(v) multiply
  const HeatMap& map = MapOf(figure, 0);
  EXPECT_NEAR(map.limits.second, 15 + 5 * 0.9 + 2, 0.1);
  EXPECT_EQ(map.limits, MapOf(figure, 1).limits);
  // a cell is a sixtieth of the axes: 0.1 of velocity and angle change friction by 0.2 of some 18
  EXPECT_NEAR(ValueAt(map, M_PI / 2, 0.5), 15 + 2.5 + 2, 0.3);
  EXPECT_NEAR(ValueAt(map, 3 * M_PI / 2, 0.5), 15 + 2.5 - 2, 0.3);
  EXPECT_NEAR(ValueAt(MapOf(figure, 2), M_PI / 2, -0.5), 15 + 2.5 - 2, 0.3) << "not swapped";
  EXPECT_TRUE(std::isnan(ValueAt(map, M_PI, 0.05))) << "never so slow";
  EXPECT_TRUE(std::isnan(ValueAt(map, M_PI, 0.7))) << "between two speeds that were held";
  EXPECT_NEAR(ValueAt(MapOf(figure, 1), M_PI / 2, 0.5), 15 + 2.5 + 2 + WarmestEnergy(view), 0.3);
}

TEST(FrictionMap, LeavesAHoleWithoutSamplesBlankAndDrawsTheSamples) {
  MappedRecording mapped;
  // nothing is kept in the second quarter of the turn, forwards
  const Eigen::VectorXd angle = mapped.View().motor_angle;
  for (Eigen::Index i = 0; i < angle.size(); ++i) {
    const bool hole = angle[i] > M_PI / 2 && angle[i] < M_PI;
    if (hole && mapped.measurements.velocity[i] > 0) mapped.selection.keep[i] = false;
  }
  const Figure figure = *MakeFrictionMap(mapped.View());
  EXPECT_TRUE(std::isnan(ValueAt(MapOf(figure, 0), 0.75 * M_PI, 0.5)));
  EXPECT_FALSE(std::isnan(ValueAt(MapOf(figure, 2), 0.75 * M_PI, -0.5)));
  EXPECT_GT(SeriesNamed(PlotNamed(Look(figure), "Forwards, cold"), "samples").points, 100);
}

}  // namespace
}  // namespace warmjoint::figures
