#include "tools/terminal/progress_line.h"

#include <gtest/gtest.h>

namespace warmjoint {
namespace {

TEST(ProgressLine, PutsWholeLinesIntoAPipeAndNotAtOnce) {
  testing::internal::CaptureStderr();
  {
    ProgressLine line;
    EXPECT_FALSE(line.Due());
    line.Show("half");
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "half\n");
}

TEST(ProgressLine, TellsTimesInTheirUnits) {
  EXPECT_EQ(DurationInWords(45.2), "45 s");
  EXPECT_EQ(DurationInWords(200), "3 min 20 s");
  EXPECT_EQ(DurationInWords(7500), "2 h 5 min");
  EXPECT_NO_FATAL_FAILURE(DurationInWords(1e300));
}

}  // namespace
}  // namespace warmjoint
