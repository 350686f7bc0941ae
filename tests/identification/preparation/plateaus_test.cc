#include "identification/preparation/plateaus.h"

#include <gmock/gmock.h>

#include <utility>
#include <vector>

namespace warmjoint {
namespace {

using ::testing::ElementsAre;
using ::testing::Pair;

constexpr double kStep = 0.01;  // s

/// Speeds (rad/s), each held for so many samples.
Measurements Holding(const std::vector<std::pair<double, int>>& holds) {
  std::vector<double> v;
  for (const auto& [speed, count] : holds) v.insert(v.end(), static_cast<size_t>(count), speed);
  Measurements log;
  const auto n = static_cast<Eigen::Index>(v.size());
  log.time = Eigen::VectorXd::LinSpaced(n, 0, kStep * static_cast<double>(n - 1));
  log.velocity = Eigen::Map<const Eigen::VectorXd>(v.data(), n);
  return log;
}

/// Begin and end of each run.
std::vector<std::pair<Eigen::Index, Eigen::Index>> RunsOf(const Measurements& log) {
  const VelocityScale scale{.rms = 1.5, .noise = 0.001, .step = kStep};
  std::vector<std::pair<Eigen::Index, Eigen::Index>> runs;
  for (const Segment& run : CutIntoRuns(log, scale)) runs.emplace_back(run.begin, run.end);
  return runs;
}

TEST(Plateaus, AreCutWhereTheSpeedJumps) {
  EXPECT_THAT(RunsOf(Holding({{1, 60}, {2, 30}})), ElementsAre(Pair(0, 60), Pair(60, 90)));
}

TEST(Plateaus, GoOnBehindAFewOutliers) {
  EXPECT_THAT(RunsOf(Holding({{1, 60}, {1.5, 4}, {1, 60}})), ElementsAre(Pair(0, 124)));

  // but neither where the speed behind them is another, nor behind a gap in time
  EXPECT_THAT(RunsOf(Holding({{1, 60}, {1.5, 4}, {1.1, 60}})),
              ElementsAre(Pair(0, 60), Pair(60, 64), Pair(64, 124)));
  Measurements gap = Holding({{1, 60}, {1.5, 4}, {1, 60}});
  gap.time.tail(60).array() += 1;
  EXPECT_THAT(RunsOf(gap), ElementsAre(Pair(0, 60), Pair(60, 64), Pair(64, 124)));
}

TEST(Plateaus, AreNotJoinedOverWhatIsLongBesideThem) {
  // four samples are brief beside 60, and not beside 20, however much comes before those
  EXPECT_THAT(RunsOf(Holding({{1, 200}, {2, 20}, {2.5, 4}, {2, 60}})),
              ElementsAre(Pair(0, 200), Pair(200, 220), Pair(220, 224), Pair(224, 284)));
}

}  // namespace
}  // namespace warmjoint
