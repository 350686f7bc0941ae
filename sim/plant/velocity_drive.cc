#include "sim/plant/velocity_drive.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace warmjoint {
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

VelocityReference::VelocityReference(const std::vector<MotionSegment>& plan, double acceleration,
                                     double settling) {
  double velocity = 0;
  double begin = 0;
  double free_since = -std::numeric_limits<double>::infinity();
  for (const MotionSegment& segment : plan) {
    // the ramp ends a settling time before the boundary, but not before the last ramp did
    const double change = std::abs(segment.velocity - velocity) / acceleration;
    if (change > 0) {
      const double start = std::max(begin - settling - change, free_since);
      // a ramp that follows on the last one at once begins with its end
      if (corners_.empty() || start > corners_.back().time) corners_.push_back({start, velocity});
      corners_.push_back({start + change, segment.velocity});
      free_since = start + change;
    }
    velocity = segment.velocity;
    begin += segment.duration;
  }
  if (corners_.empty()) corners_.push_back({0, 0});
}

VelocityReference VelocityReference::Through(const std::vector<VelocityCorner>& corners,
                                             double acceleration, double settling) {
  VelocityReference reference;
  // from rest to the first velocity, a settling time before the motion begins
  const double first = corners.front().velocity;
  if (first != 0) {
    reference.corners_.push_back({-settling - std::abs(first) / acceleration, 0});
    reference.corners_.push_back({-settling, first});
  } else {
    reference.corners_.push_back({0, 0});
  }
  // corners in order of time
  for (const VelocityCorner& corner : corners) {
    if (corner.time > reference.corners_.back().time) reference.corners_.push_back(corner);
  }
  return reference;
}

double VelocityReference::run_up() const {
  // distance along each straight line before 0
  double distance = 0;
  for (size_t i = 0; i + 1 < corners_.size() && corners_[i].time < 0; ++i) {
    const VelocityCorner& from = corners_[i];
    const VelocityCorner& to = corners_[i + 1];
    const double end = std::min(to.time, 0.0);
    const double share = (end - from.time) / (to.time - from.time);
    const double at_end = from.velocity + share * (to.velocity - from.velocity);
    distance += (end - from.time) * (from.velocity + at_end) / 2;
  }
  const VelocityCorner& last = corners_.back();
  return last.time < 0 ? distance - last.time * last.velocity : distance;
}

double VelocityReference::Velocity(double time) {
  while (next_ < corners_.size() && corners_[next_].time <= time) ++next_;
  slope_ = 0;
  if (next_ == 0) return corners_.front().velocity;
  const VelocityCorner& from = corners_[next_ - 1];
  if (next_ == corners_.size()) return from.velocity;
  const VelocityCorner& to = corners_[next_];
  slope_ = (to.velocity - from.velocity) / (to.time - from.time);
  return from.velocity + slope_ * (time - from.time);
}

}  // namespace warmjoint
