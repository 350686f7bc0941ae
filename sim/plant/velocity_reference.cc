#include "sim/plant/velocity_reference.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace warmjoint::inline sim {

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
  // way of each straight line before 0
  double way = 0;
  for (size_t i = 0; i + 1 < corners_.size() && corners_[i].time < 0; ++i) {
    const VelocityCorner& from = corners_[i];
    const VelocityCorner& to = corners_[i + 1];
    const double end = std::min(to.time, 0.0);
    const double share = (end - from.time) / (to.time - from.time);
    const double at_end = from.velocity + share * (to.velocity - from.velocity);
    way += (end - from.time) * (from.velocity + at_end) / 2;
  }
  const VelocityCorner& last = corners_.back();
  return last.time < 0 ? way - last.time * last.velocity : way;
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

}  // namespace warmjoint::inline sim
