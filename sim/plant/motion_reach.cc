#include "sim/plant/motion_reach.h"

#include <algorithm>

#include "models/foundation/bad_input.h"

namespace warmjoint::inline sim {
namespace {

void CheckPosition(const JointRoom& room, double position) {
  const auto [lower, upper] = room.limits;
  const double slack = 1e-9 * std::max(1.0, upper - lower);
  if (position >= lower - slack && position <= upper + slack) return;
  Refuse({room.scenario.name},
         "the motion takes joint '{}' to {:.4g}, beyond its limits {:.4g} to "
         "{:.4g}; let it travel between limits, or hold speeds for less time",
         room.scenario.joint, position, lower, upper);
}

}  // namespace

void CheckReach(const JointRoom& room, const std::vector<MotionSegment>& plan, double position) {
  // ends of segments are the extremes of a motion at constant speeds
  for (const MotionSegment& segment : plan) {
    position += segment.velocity * segment.duration;
    CheckPosition(room, position);
  }
}

void CheckReach(const JointRoom& room, const std::vector<VelocityCorner>& corners,
                double position) {
  const double end = room.scenario.duration;
  for (size_t i = 1; i < corners.size() && corners[i - 1].time < end; ++i) {
    // the way between two corners, of which the last may come after the end
    const VelocityCorner& from = corners[i - 1];
    VelocityCorner to = corners[i];
    if (to.time > end) {
      const double share = (end - from.time) / (to.time - from.time);
      to = {end, from.velocity + share * (to.velocity - from.velocity)};
    }
    // it is farthest where the joint turns back, or where it ends
    if (from.velocity * to.velocity < 0) {
      const double turn = from.velocity / (from.velocity - to.velocity) * (to.time - from.time);
      CheckPosition(room, position + turn * from.velocity / 2);
    }
    position += (to.time - from.time) * (from.velocity + to.velocity) / 2;
    CheckPosition(room, position);
  }

  // behind the last corner the speed stays
  const VelocityCorner& last = corners.back();
  CheckPosition(room, position + std::max(end - last.time, 0.0) * last.velocity);
}

}  // namespace warmjoint::inline sim
