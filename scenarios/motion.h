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

/// Fourier excitation: the velocity is a sum of cosines and sines of a period and its harmonics, their
/// coefficients drawn for each realization; 0 at time 0, its largest value is `speed`.
struct FourierMotion {
  double period = 0;     // s
  double harmonics = 0;  // a whole number, 1 or more
  double speed = 0;      // rad/s or m/s

  bool operator==(const FourierMotion&) const = default;
};

/// Pick and place: from one place to the next, drawn uniformly between two limits, by ramps of one
/// acceleration up to a speed and down from it, with a pause at each place.
struct MovesBetween {
  std::pair<double, double> between;  // lower, upper, rad or m
  double speed = 0;                   // rad/s or m/s, at most
  double acceleration = 0;            // rad/s^2 or m/s^2
  double pause = 0;                   // s

  bool operator==(const MovesBetween&) const = default;
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
  std::vector<MotionPhase> phases;       // instead of all above: in turn, again from the first
  std::vector<VelocityCorner> corners;   // instead of all above, in order of time
  double start = 0;                      // with corners: position at time 0, rad or m
  std::optional<FourierMotion> fourier;  // instead of all above but start
  std::optional<MovesBetween> moves;     // instead of all above

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

/// Where the motion begins, rad or m: at the lower travel limit; at `start` with corners and
/// `fourier`; in the middle of `moves`; else at 0.
double StartPosition(const Motion& motion, std::pair<double, double> joint_limits);

/// The plan that covers exactly `duration` seconds: the last segment is cut. Draws come from
/// `random`. joint_limits: rad or m, used by motions that travel; motion must have been checked and
/// is none that FollowsCorners.
std::vector<MotionSegment> PlanMotion(const Motion& motion, double duration,
                                      std::pair<double, double> joint_limits, RandomStream& random);

/// Whether the velocity is linear from corner to corner instead of held from segment to segment.
bool FollowsCorners(const Motion& motion);

/// The corners of a motion that FollowsCorners, over `duration` seconds. Draws come from `random`.
std::vector<VelocityCorner> PlanCorners(const Motion& motion, double duration,
                                        RandomStream& random);

}  // namespace warmjoint::inline scenarios
