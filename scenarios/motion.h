// Piecewise constant-velocity motion: the plan that a plant carries out.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "models/foundation/random_stream.h"
#include "scenarios/distribution.h"

namespace warmjoint::inline scenarios {

/// Which speed and which sign come next.
///   alternating: the next speed of the list or a new draw; the sign changes with each segment. A
///     list of even length is shifted by one after each round, so that every speed gets both signs.
///   in_order: each speed twice, forwards and then backwards, before the next: a ladder.
///   shuffled: rounds over all speeds in both signs, in an order drawn anew for each round; with
///     draws, each a new speed with a sign by chance. Where the motion travels between limits the
///     sign must change with each segment: then only the speeds are shuffled.
enum class SegmentOrder { alternating, shuffled, in_order };

/// Work and break times that interrupt the motion; it goes on after a break where it stopped.
struct Rests {
  double run = 0;   // s of motion before each rest
  double rest = 0;  // s of rest

  bool operator==(const Rests&) const = default;
};

struct MotionPhase;

/// A corner of a velocity that is linear from corner to corner.
struct VelocityCorner {
  double time = 0;      // s, from the start of the recording
  double velocity = 0;  // rad/s or m/s, signed

  bool operator==(const VelocityCorner&) const = default;
};

/// Piecewise constant velocity: a speed for each segment, held for a time or until a joint limit;
/// or phases of such motions; or a velocity that is given by its corners, as a recorded one is.
struct Motion {
  std::vector<double> speed_list;           // rad/s or m/s, positive; used in turn
  std::optional<Distribution> speed_draws;  // instead of the list: a new draw for each segment
  double hold = 0;                          // s for each segment; 0: travel between limits
  std::optional<std::pair<double, double>> travel;  // lower, upper, rad or m
  bool travel_between_joint_limits = false;         // travel between the robot's own limits
  SegmentOrder order = SegmentOrder::alternating;
  std::optional<Rests> rests;
  std::vector<MotionPhase> phases;      // instead of all above: in turn, again from the first
  std::vector<VelocityCorner> corners;  // instead of all above, in order of time; mujoco plant only
  double start = 0;                     // with corners: position at time 0, rad or m

  bool operator==(const Motion&) const;
};

/// A motion for a time, as part of a longer one. It holds speeds; it neither travels nor has
/// phases.
struct MotionPhase {
  double duration = 0;           // s
  std::optional<Motion> motion;  // none: a rest

  bool operator==(const MotionPhase&) const = default;
};

/// One piece of the plan.
struct MotionSegment {
  double duration = 0;  // s
  double velocity = 0;  // rad/s or m/s, signed; 0: rest
};

/// The limits that the motion travels between, or nothing where it holds speeds for a time.
/// joint_limits: the robot's own, rad or m.
std::optional<std::pair<double, double>> TravelLimits(const Motion& motion,
                                                      std::pair<double, double> joint_limits);

/// Where the motion begins, rad or m: at the lower travel limit; at `start` with corners; else at
/// 0.
double StartPosition(const Motion& motion, std::pair<double, double> joint_limits);

/// The plan that covers exactly `duration` seconds: the last segment is cut. Draws come from
/// `random`. joint_limits: rad or m, used by motions that travel; motion must have been checked and
/// has no corners.
std::vector<MotionSegment> PlanMotion(const Motion& motion, double duration,
                                      std::pair<double, double> joint_limits, RandomStream& random);

}  // namespace warmjoint::inline scenarios
