#include "identification/identifiers/condense.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "models/friction/sign.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

using Eigen::Index;

constexpr double kTravelParts = 48;
constexpr double kTurnParts = 24;

/// The longest path of the joint within a row, rad or m.
double LongestDistance(const LogSamples& m) {
  const double travel = m.position.maxCoeff() - m.position.minCoeff();
  const double distance = travel / kTravelParts;
  if (!KnowsMotorAngle(m)) return distance;
  return std::min(distance, 2 * std::numbers::pi / (kTurnParts * std::abs(m.gear)));
}

/// The segment of each sample, -1 for none. [N]
Eigen::ArrayXi SegmentOf(const LogView& all) {
  Eigen::ArrayXi segment = Eigen::ArrayXi::Constant(all.measurements.size(), -1);
  const std::vector<Segment>& segments = all.selection.segments;
  for (size_t s = 0; s < segments.size(); ++s) {
    segment.segment(segments[s].begin, segments[s].end - segments[s].begin) = static_cast<int>(s);
  }
  return segment;
}

/// First sample of each row, and N.
std::vector<Index> RowsOf(const LogView& all, Index together) {
  const LogSamples& m = all.measurements;
  const auto& keep = all.selection.keep;
  const Eigen::ArrayXi segment = SegmentOf(all);
  const double longest = LongestStep(m.time), distance = LongestDistance(m);
  std::vector<Index> first{0};
  // a row ends where the motion, the segment or the recording does
  for (Index i = 1; i < m.size(); ++i) {
    const bool starts = std::ranges::binary_search(m.further_starts, i);
    const Index begin = first.back();
    const bool alike = keep[i] == keep[begin] && segment[i] == segment[begin] &&
                       Sign(m.velocity[i]) == Sign(m.velocity[begin]) &&
                       m.time[i] - m.time[i - 1] <= longest;
    // kept samples of one row are close to each other; samples between segments need not be
    const bool near = std::abs(m.position[i] - m.position[begin]) <= distance || !keep[i];
    if (starts || !alike || !near || i - begin >= together) first.push_back(i);
  }
  first.push_back(m.size());
  return first;
}

}  // namespace

CondensedLog Condense(const LogView& all, Index rows) {
  const Index together = (all.selection.count() + rows - 1) / rows;
  if (together <= 1) {
    // few enough samples: each is its own row
    std::vector<Index> each(static_cast<size_t>(all.measurements.size()) + 1);
    std::iota(each.begin(), each.end(), 0);
    return {all, std::move(each)};
  }
  std::vector<Index> first = RowsOf(all, together);
  const auto count = static_cast<Index>(first.size()) - 1;

  // the columns
  LogView view = all;
  ForEachColumn(view.measurements, [&](Eigen::VectorXd& column) {
    if (column.size() == 0) return;
    Eigen::VectorXd means(count);
    for (Index r = 0; r < count; ++r) {
      means[r] = column.segment(first[r], first[r + 1] - first[r]).mean();
    }
    column = std::move(means);
  });

  // and the fields that refer to samples
  const auto row = [&](Index sample) {
    return std::lower_bound(first.begin(), first.end(), sample) - first.begin();
  };
  // the samples of a row are kept or left out together
  view.selection.keep.resize(count);
  for (Index r = 0; r < count; ++r) view.selection.keep[r] = all.selection.keep[first[r]];
  for (Index& start : view.measurements.further_starts) start = row(start);
  view.measurements.inserted.clear();
  // gaps are those of the samples themselves
  view.measurements.gaps = GapsOf(all.measurements.time);
  for (LogGap& gap : *view.measurements.gaps) gap.behind = row(gap.behind);
  for (Segment& one : view.selection.segments) {
    one.begin = row(one.begin);
    one.end = row(one.end);
  }
  return {std::move(view), std::move(first)};
}

}  // namespace warmjoint
