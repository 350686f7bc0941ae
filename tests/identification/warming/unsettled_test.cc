#include "identification/warming/unsettled.h"

#include <gmock/gmock.h>

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

}  // namespace
}  // namespace warmjoint
