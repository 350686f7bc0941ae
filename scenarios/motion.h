// Piecewise constant-velocity motion: the plan that a plant carries out.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "models/foundation/random_stream.h"
#include "scenarios/distribution.h"

namespace warmjoint {

enum class SegmentOrder { alternating, shuffled, in_order };

/// Work and break times that interrupt the motion.
struct Rests {
  double run = 0;   // s of motion before each rest
  double rest = 0;  // s of rest
};

/// Piecewise constant velocity: a speed for each segment, held for a time or until a joint limit.
struct Motion {
  std::vector<double> speed_list;           // rad/s or m/s, positive; used in turn
  std::optional<Distribution> speed_draws;  // instead of the list: a new draw for each segment
  double hold = 0;                          // s for each segment; 0: travel between limits
  std::optional<std::pair<double, double>> travel;  // lower, upper, rad or m
  bool travel_between_joint_limits = false;         // travel between the robot's own limits
  SegmentOrder order = SegmentOrder::alternating;
  std::optional<Rests> rests;
};

/// One piece of the plan.
struct MotionSegment {
  double duration = 0;  // s
  double velocity = 0;  // rad/s or m/s, signed; 0: rest
};

/// The plan that covers `duration` seconds. Draws come from `random`. limits: of the joint, rad or
/// m, used by motions that travel.
std::vector<MotionSegment> PlanMotion(const Motion& motion, double duration,
                                      std::pair<double, double> limits, RandomStream& random);

}  // namespace warmjoint
