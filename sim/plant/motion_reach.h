// Whether a joint has room for a motion.
#pragma once

#include <utility>
#include <vector>

#include "scenarios/motion.h"
#include "scenarios/scenario.h"

namespace warmjoint::inline sim {

/// Where a motion may go.
struct JointRoom {
  const Scenario& scenario;          // whose joint it is, and how long it moves
  std::pair<double, double> limits;  // rad or m; infinite where the joint has none
};

/// Throws BadInput where a motion from a position, rad or m, leaves the joint's limits: the first is
/// made of pieces at constant speed, the second of a velocity that is linear between corners.
void CheckReach(const JointRoom& room, const std::vector<MotionSegment>& plan, double position);
void CheckReach(const JointRoom& room, const std::vector<VelocityCorner>& corners, double position);

}  // namespace warmjoint::inline sim
