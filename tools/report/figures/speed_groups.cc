#include "tools/report/figures/speed_groups.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "tools/report/draw/ticks.h"

namespace warmjoint::report {
namespace {

constexpr double kAlike = 0.05;  // relative difference of speeds that count as one
constexpr std::size_t kMostSpeeds = 4;
constexpr std::size_t kGroups = 3;
constexpr Hue kHues[kMostSpeeds] = {Hue::blue, Hue::green, Hue::orange, Hue::vermilion};

/// Mean speeds of the segments, one for each kept sample, ascending.
std::vector<double> SpeedsOfSamples(const FitView& view) {
  std::vector<double> speeds;
  for (const Segment& segment : view.selection.segments) {
    const auto kept = view.selection.keep.segment(segment.begin, segment.end - segment.begin);
    speeds.insert(speeds.end(), static_cast<std::size_t>(kept.count()), std::abs(segment.velocity));
  }
  std::sort(speeds.begin(), speeds.end());
  return speeds;
}

/// [slowest, fastest] of each group of ascending speeds.
std::vector<std::pair<double, double>> RangesOf(const std::vector<double>& speeds) {
  std::vector<std::pair<double, double>> ranges;
  for (double speed : speeds) {
    if (ranges.empty() || speed > (1 + kAlike) * ranges.back().second) {
      ranges.emplace_back(speed, speed);
    }
    ranges.back().second = speed;
  }
  if (ranges.size() <= kMostSpeeds) return ranges;

  ranges.clear();
  for (std::size_t i = 0; i < kGroups; ++i) {
    const std::size_t first = i * speeds.size() / kGroups;
    const std::size_t last = (i + 1) * speeds.size() / kGroups - 1;
    const double from = i == 0 ? speeds[first] : ranges.back().second;
    if (speeds[last] > from || i == 0) ranges.emplace_back(from, speeds[last]);
  }
  return ranges;
}

}  // namespace

std::vector<SpeedGroup> GroupBySpeed(const FitView& view, int direction) {
  const auto ranges = RangesOf(SpeedsOfSamples(view));
  const std::string unit = UnitText(kVelocityUnit.For(view.joint));
  std::vector<SpeedGroup> groups;
  for (const auto& [slowest, fastest] : ranges) {
    SpeedGroup group{slowest, fastest, kHues[groups.size()], "", {}};
    const std::string from = SignificantText(slowest, 2), to = SignificantText(fastest, 2);
    group.label = from == to || fastest <= (1 + kAlike) * slowest
                      ? fmt::format("{} {}", to, unit)
                      : fmt::format("{} … {} {}", from, to, unit);
    groups.push_back(group);
  }
  for (const Segment& segment : view.selection.segments) {
    if (segment.velocity * direction <= 0) continue;
    const double speed = std::abs(segment.velocity);
    const auto fits = [&](const SpeedGroup& group) { return speed <= group.fastest; };
    const auto group = std::find_if(groups.begin(), groups.end(), fits);
    if (group == groups.end()) continue;
    for (Eigen::Index i = segment.begin; i < segment.end; ++i) {
      if (view.selection.keep[i]) group->samples.push_back(i);
    }
  }
  return groups;
}

}  // namespace warmjoint::report
