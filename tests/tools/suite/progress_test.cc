#include "tools/suite/progress.h"

#include <gtest/gtest.h>

namespace warmjoint {
namespace {

TEST(Progress, TellsRateTimeLeftAndFailures) {
  Progress progress(50, 10);
  EXPECT_EQ(progress.Line(0), "10/50 realizations");
  progress.Add(20);
  progress.AddFailure("not_converged");
  progress.AddFailure("crashed");
  progress.AddFailure("not_converged");
  EXPECT_EQ(progress.Line(10),
            "30/50 realizations, 2/s, 10 s left, failures: crashed 1, not_converged 2");
}

TEST(Progress, GoesOnCountingAfterAResume) {
  Progress progress(50, 10, {{"crashed", 2}});
  progress.AddFailure("crashed");
  EXPECT_EQ(progress.Line(0), "10/50 realizations, failures: crashed 3");
}

TEST(Progress, TellsLongTimesInLargerUnits) {
  Progress progress(101, 0);
  progress.Add(1);
  EXPECT_EQ(progress.Line(2), "1/101 realizations, 0.5/s, 3 min 20 s left");
  EXPECT_EQ(progress.Line(100), "1/101 realizations, 0.01/s, 2 h 46 min left");
}

}  // namespace
}  // namespace warmjoint
