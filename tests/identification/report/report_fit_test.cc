#include "identification/report/report_fit.h"

#include <gtest/gtest.h>

#include "identification/inference/inference.h"
#include "identification/preparation/check.h"
#include "tests/support/warm_recording.h"

namespace warmjoint {
namespace {

TEST(ReportFit, SaysWhatTheRecordingLacksForAFitThatDidNotComeToRest) {
  const Measurements m =
      test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(60, 1), 0.5, 1);
  const Fit fit = Refused("kalman", {Status::not_converged, "it ran away", FrictionKind::warm_up});
  const Estimate estimate = ReportFit(fit, Infer(fit), m);
  EXPECT_EQ(estimate.status, Status::not_converged);
  EXPECT_EQ(estimate.message, "it ran away; " + WhyNotConverged(m, FrictionKind::warm_up));
}

}  // namespace
}  // namespace warmjoint
