#include "identification/report/unsettled.h"

#include <gmock/gmock.h>

#include "identification/inference/inference.h"
#include "identification/report/report_fit.h"
#include "tests/support/warm_recording.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

TEST(Unsettled, SaysWhatTheRecordingLacks) {
  const auto record = [](Eigen::Index n) {
    return test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(n, 1), 0.5, 1);
  };
  EXPECT_THAT(WhyUnsettled(record(60), FrictionKind::warm_up), HasSubstr("the log lasts 59 s"));
  EXPECT_THAT(WhyUnsettled(record(60), FrictionKind::stribeck),
              HasSubstr("the slowest below 1/20 of the fastest"));
  EXPECT_THAT(WhyUnsettled(record(3600), FrictionKind::warm_up),
              HasSubstr("does the torque column"));
}

TEST(Unsettled, StandsInTheReportOfAFitThatDidNotComeToRest) {
  const Measurements m =
      test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(60, 1), 0.5, 1);
  const Fit fit = Refused("kalman", {Status::not_converged, "it ran away", FrictionKind::warm_up});
  const Estimate estimate = ReportFit(fit, Infer(fit), m);
  EXPECT_EQ(estimate.status, Status::not_converged);
  EXPECT_EQ(estimate.message, "it ran away; " + WhyUnsettled(m, FrictionKind::warm_up));
}

}  // namespace
}  // namespace warmjoint
