#include "sim/plant/drive_bandwidth.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace warmjoint::inline sim {
namespace {

/// Of the time that a motion moves, for which a bandwidth has to do: one slow piece does not make the
/// whole drive fast.
constexpr double kShareThatMatters = 0.95;

/// The bandwidth that one segment needs for friction, rad/s.
double ForFriction(const DriveTask& task, const MotionSegment& segment) {
  constexpr double decay = 6.6, slow_decay = 4.6;  // to 1 %: of a double pole and of a single one
  constexpr double lead = 10 - slow_decay;         // what the settling time leaves for sticking
  const double speed = std::abs(segment.velocity);
  // what the level and the slope of friction ask for, 1/s
  const double b = (2 * task.level / speed + slow_decay * task.slope) / task.inertia;
  const double d = segment.duration;
  return std::max(b / lead, (decay + std::sqrt(decay * decay + 0.4 * b * d)) / (0.2 * d));
}

}  // namespace

double SufficientBandwidth(const DriveTask& task, const std::vector<MotionSegment>& segments) {
  std::vector<std::pair<double, double>> needs;  // bandwidth and duration of each moving segment
  double moving = 0;
  for (const MotionSegment& segment : segments) {
    if (segment.velocity == 0 || segment.duration <= 0) continue;
    needs.emplace_back(ForFriction(task, segment), segment.duration);
    moving += segment.duration;
  }
  if (needs.empty()) return 0;

  // from the easiest segment on, until enough of the time is reached
  std::sort(needs.begin(), needs.end());
  double bandwidth = 0, reached = 0;
  for (const auto& [need, duration] : needs) {
    bandwidth = need;
    reached += duration;
    if (reached >= kShareThatMatters * moving) break;
  }
  return std::max(bandwidth, 10 * std::sqrt(task.gravity / task.inertia));
}

std::vector<MotionSegment> HoldsBetween(const std::vector<VelocityCorner>& corners) {
  std::vector<MotionSegment> holds;
  for (size_t i = 1; i < corners.size(); ++i) {
    const VelocityCorner &from = corners[i - 1], &to = corners[i];
    if (from.velocity == to.velocity) holds.push_back({to.time - from.time, to.velocity});
  }
  return holds;
}

}  // namespace warmjoint::inline sim
