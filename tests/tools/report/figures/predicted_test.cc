#include "tools/report/figures/predicted.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/report/look.h"
#include "tests/tools/report/warm_recording.h"
#include "tools/report/figures/log_figure.h"

namespace warmjoint::report {
namespace {

using ::testing::HasSubstr;

TEST(Predicted, SaysHowFarPredictionAndMeasurementDiffer) {
  const WarmRecording warm;
  const Figure figure =
      *MakePredicted(MakeFitView(warm.measurements, warm.selection, warm.estimate));
  const Drawn drawn = DrawLight(figure);
  EXPECT_EQ(drawn.plots[0].x, drawn.plots[0].y) << "one scale: equal lies on the diagonal";
  // noise of 0.5 over 1200 samples: known to 2 %
  EXPECT_THAT(figure.finding, HasSubstr("differ by 0.5"));
  EXPECT_FALSE(MakePredicted(MakeFitView(warm.measurements, warm.selection, {})));
}

TEST(LogFigure, ShowsTheRecordingWithItsKeptSamples) {
  WarmRecording warm;
  warm.selection.keep.head(600).setConstant(false);
  const Figure figure = MakeLogFigure(MakeFitView(warm.measurements, warm.selection, {}));
  const Drawn drawn = DrawLight(figure);
  ASSERT_EQ(drawn.plots.size(), 3u);
  EXPECT_NEAR(SeriesNamed(drawn.plots[0], "kept for the fit").x.first, 10, 0.01) << "minutes";
  EXPECT_NEAR(SeriesNamed(drawn.plots[0], "all samples").x.first, 0, 0.01);
  EXPECT_THAT(figure.finding, HasSubstr("Of 1200 samples 50 % are kept"));
}

}  // namespace
}  // namespace warmjoint::report
