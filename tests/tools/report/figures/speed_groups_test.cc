#include "tools/report/figures/speed_groups.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace warmjoint::report {
namespace {

using ::testing::ElementsAre;

/// A view of segments of 100 samples, or of the lengths given, at these velocities.
FitView Moving(const std::vector<double>& velocities, std::vector<Eigen::Index> lengths = {}) {
  lengths.resize(velocities.size(), 100);
  FitView view;
  Eigen::Index begin = 0;
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    view.selection.segments.push_back({begin, begin + lengths[i], velocities[i]});
    begin += lengths[i];
  }
  view.selection.keep.setConstant(begin, true);
  return view;
}

std::vector<std::string> Labels(const std::vector<SpeedGroup>& groups) {
  std::vector<std::string> labels;
  for (const SpeedGroup& group : groups) labels.push_back(group.label);
  return labels;
}

TEST(GroupBySpeed, NamesEverySpeedOfAFew) {
  const FitView view = Moving({1.5, -0.3, 0.1, -0.1, 0.3, 0.6, -1, 0.1001});
  const auto forwards = GroupBySpeed(view, 1), backwards = GroupBySpeed(view, -1);
  EXPECT_THAT(Labels(forwards),
              ElementsAre("0.1 rad/s", "0.3 rad/s", "0.6 rad/s", "1 rad/s", "1.5 rad/s"));
  EXPECT_EQ(Labels(backwards), Labels(forwards));
  EXPECT_EQ(forwards[0].samples.size(), 200u);
  EXPECT_EQ(backwards[0].samples.size(), 100u);
  EXPECT_EQ(forwards[3].samples.size(), 0u) << "1 rad/s is backwards alone";
  EXPECT_EQ(forwards[4].samples.front(), 0) << "the first segment";
  for (std::size_t i = 1; i < forwards.size(); ++i) EXPECT_NE(forwards[i].hue, forwards[i - 1].hue);
}

TEST(GroupBySpeed, LetsAStraySegmentJoinItsNeighbour) {
  // 5 of 405 samples
  const auto groups = GroupBySpeed(Moving({0.1, 0.083, 0.3, 0.6, 1}, {100, 5, 100, 100, 100}), 1);
  EXPECT_THAT(Labels(groups), ElementsAre("0.1 rad/s", "0.3 rad/s", "0.6 rad/s", "1 rad/s"));
  EXPECT_EQ(groups[0].samples.size(), 105u);
}

TEST(GroupBySpeed, MakesThreeBinsOfManySpeeds) {
  std::vector<double> speeds;
  for (int i = 0; i < 30; ++i) speeds.push_back(0.1 + 0.03 * i);
  const auto groups = GroupBySpeed(Moving(speeds), 1);
  ASSERT_EQ(groups.size(), 3u);
  EXPECT_EQ(groups[0].label, "0.1 … 0.37 rad/s");
  EXPECT_EQ(groups[2].fastest, speeds.back());
  std::size_t all = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    all += groups[i].samples.size();
    EXPECT_NEAR(static_cast<double>(groups[i].samples.size()), 1000, 200) << "two speeds";
    if (i > 0) {
      EXPECT_GT(groups[i].slowest, groups[i - 1].fastest) << "no speed in two bins";
    }
  }
  EXPECT_EQ(all, 3000u);
}

}  // namespace
}  // namespace warmjoint::report
