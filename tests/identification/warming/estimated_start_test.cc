#include "identification/warming/estimated_start.h"

#include <gtest/gtest.h>
#include <warmjoint/friction_model.h>

#include "tests/support/warm_recording.h"

namespace warmjoint {
namespace {

/// Eleven gaps of 100 s, before the samples 50, 100, ... 550.
Measurements WithGaps() {
  Measurements m = test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(600, 1), 0, 1);
  for (Eigen::Index i = 0; i < m.size(); ++i) m.time[i] += 100 * static_cast<double>(i / 50);
  return m;
}

TEST(StartOf, IsColdWhereNothingIsEstimated) {
  const CourseStart start = StartOf({}, WithGaps());
  EXPECT_EQ(start.energy, 0);
  EXPECT_TRUE(start.jumps.empty());
}

TEST(StartOf, PutsEachJumpBehindItsGapWhateverTheOrderOfTheNames) {
  Estimate estimate;
  estimate.parameters.push_back({"energy_jump_10", 10, "N.m", {}, {}});
  for (int i = 9; i > 0; --i) {
    estimate.parameters.push_back(
        {"energy_jump_" + std::to_string(i), static_cast<double>(i), "N.m", {}, {}});
  }
  estimate.parameters.push_back({"initial_energy", -4, "N.m", {}, {}});
  const CourseStart start = StartOf(estimate, WithGaps());
  EXPECT_EQ(start.energy, -4);
  ASSERT_EQ(start.jumps.size(), 11);
  for (size_t i = 0; i < 11; ++i) {
    EXPECT_EQ(start.jumps[i].sample, static_cast<Eigen::Index>(50 * (i + 1)));
    // the last one is not estimated
    EXPECT_EQ(start.jumps[i].change, i < 10 ? static_cast<double>(i + 1) : 0);
  }
}

}  // namespace
}  // namespace warmjoint
