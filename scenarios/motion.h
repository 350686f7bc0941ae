// Piecewise constant-velocity motion: the plan that a plant carries out.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "models/foundation/node.h"
#include "models/foundation/random_stream.h"
#include "scenarios/distribution.h"

namespace warmjoint {

/// Which speed and which sign come next.
///   alternating: the next speed of the list or a new draw; the sign changes with each segment. A
///     list of even length is shifted by one after each round, so that every speed gets both signs.
///   in_order: each speed twice, forwards and then backwards, before the next: a ladder.
///   shuffled: rounds over all speeds in both signs, in an order drawn anew for each round; with
///     draws, each a new speed with a sign by chance. Where the motion travels between limits the
///     sign must change with each segment: then only the speeds are shuffled.
enum class SegmentOrder { alternating, shuffled, in_order };

inline std::span<const Word<SegmentOrder>> WordsOf(SegmentOrder) {
  static constexpr std::array words{Word{"alternating", SegmentOrder::alternating},
                                    Word{"shuffled", SegmentOrder::shuffled},
                                    Word{"in_order", SegmentOrder::in_order}};
  return words;
}

/// Work and break times that interrupt the motion.
struct Rests {
  double run = 0;
  double rest = 0;

  template <class A>
  void Serialize(A* a) {
    a->Field("run", &run,
             Needed("s", "motion before each rest", kPositive,
                    "give the seconds of motion before a rest"));
    a->Field("rest", &rest,
             Needed("s", "length of a rest", kPositive, "give the seconds of a rest"));
  }
};

struct MotionPhase;

/// A corner of a velocity that is linear from corner to corner.
struct VelocityCorner {
  double time = 0;      // s, from the start of the recording
  double velocity = 0;  // rad/s or m/s, signed
};

/// Fourier excitation: the velocity is a sum of cosines and sines of a period and its harmonics, their
/// coefficients drawn for each realization; 0 at time 0, its largest value is `speed`.
struct FourierMotion {
  double period = 0;
  int harmonics = 0;
  double speed = 0;

  template <class A>
  void Serialize(A* a) {
    a->Field("period", &period,
             Needed("s", "of the slowest harmonic", kPositive,
                    "give the seconds after which it repeats itself"));
    a->Field("harmonics", &harmonics,
             Needed("", "how many", {.at_least = 1, .at_most = 1000},
                    "give the number of harmonics, as 5"));
    a->Field("speed", &speed,
             Needed("rad/s", "largest speed", kPositive, "give the largest speed, rad/s or m/s"));
  }
};

/// Pick and place: from one place to the next, drawn uniformly between two limits, by ramps of one
/// acceleration up to a speed and down from it, with a pause at each place.
struct MovesBetween {
  std::pair<double, double> between;
  double speed = 0;
  double acceleration = 0;
  double pause = 0;

  /// s; a move whose ramps are shorter is left out.
  static constexpr double kShortestRamp = 1e-6;

  /// Of a move between the limits, s.
  double LongestRamp() const {
    return std::min(speed / acceleration,
                    std::sqrt((between.second - between.first) / acceleration));
  }

  template <class A>
  void Serialize(A* a) {
    a->Field("between", &between,
             Needed("rad", "limits between which the places are drawn uniformly", {},
                    "give [lower, upper], rad or m"));
    a->Field("speed", &speed,
             Needed("rad/s", "largest speed", kPositive, "give the largest speed, rad/s or m/s"));
    a->Field(
        "acceleration", &acceleration,
        Needed("rad/s^2", "of the ramps", kPositive, "give that of the ramps, rad/s^2 or m/s^2"));
    a->Field("pause", &pause, WithDefault("s", "at each place", kNotNegative));
    // of places drawn uniformly, 99 % are then far enough from the last
    a->Check(
        LongestRamp() >= 10 * kShortestRamp, "",
        "moves with ramps of 1e-5 s or more: widen `between`, raise speed or lower acceleration");
  }
};

/// Speeds as a file has them: a list, or a distribution.
struct Speeds {
  std::vector<double> list;           // rad/s or m/s, positive
  std::optional<Distribution> draws;  // instead of the list
};
void ReadValue(const Node& node, Speeds* value, const FieldInfo& info);
Tree WriteValue(const Speeds& value);

/// What a motion travels between as a file has it: two limits, or the words joint_limits.
struct Travel {
  std::optional<std::pair<double, double>> limits;  // lower, upper, rad or m
  bool joint_limits = false;                        // the robot's own
};
void ReadValue(const Node& node, Travel* value, const FieldInfo& info);
Tree WriteValue(const Travel& value);

/// [time, velocity].
void ReadValue(const Node& node, VelocityCorner* value, const FieldInfo& info);
Tree WriteValue(const VelocityCorner& value);

/// Piecewise constant velocity: a speed for each segment, held for a time or until a joint limit;
/// or phases of such motions; or a velocity that is given by its corners, as a recorded one is.
struct Motion {
  Speeds speeds;    // a list is used in turn; else a new draw for each segment
  double hold = 0;  // s for each segment; 0: travel between limits
  Travel travel;
  SegmentOrder order = SegmentOrder::alternating;
  std::optional<Rests> rests;
  std::vector<MotionPhase> phases;       // instead of all above: in turn, again from the first
  std::vector<VelocityCorner> corners;   // instead of all above, in order of time
  double start = 0;                      // with corners: position at time 0, rad or m
  std::optional<FourierMotion> fourier;  // instead of all above but start
  std::optional<MovesBetween> moves;     // instead of all above

  /// Speeds that are held or between limits, without phases.
  bool steady() const { return !speeds.list.empty() || speeds.draws; }
  /// Whether the corners follow each other in time.
  bool CornersAscend() const;

  template <class A>
  void Serialize(A* a);
  /// The members of a motion that holds speeds.
  template <class A>
  void SerializeHeld(A* a);
};

/// A motion for a time, as part of a longer one. It holds speeds; it neither travels nor has
/// phases.
struct MotionPhase {
  double duration = 0;           // s
  std::optional<Motion> motion;  // none: a rest

  template <class A>
  void Serialize(A* a);
};

template <class A>
void Motion::SerializeHeld(A* a) {
  constexpr auto left_out = AtDefault::left_out;
  a->Field("speeds", &speeds,
           WithDefault("rad/s", "a list, or a distribution from which each segment draws"));
  a->Field(
      "hold", &hold,
      {.unit = "s", .bounds = {.above = 0}, .meaning = "at each speed", .at_default = left_out});
  a->Field("order", &order,
           LeftOut("`alternating`: each next speed with the other sign; `in_order`: each speed "
                   "forwards, then backwards; `shuffled`: rounds over all speeds and both signs"));
  a->Field("rests", &rests, {.meaning = "the motion stops for a while and goes on where it was"});
}

template <class A>
void Motion::Serialize(A* a) {
  constexpr auto left_out = AtDefault::left_out;
  SerializeHeld(a);
  a->Field(
      "travel", &travel,
      WithDefault(
          "rad",
          "each speed until a limit is reached, in place of `hold`; or the robot's own limits"));

  // other kinds of motion, each by a key of its own
  a->Field("phases", &phases, LeftOut("motions and rests in turn"));
  a->Field("corners", &corners,
           LeftOut("a velocity that is linear between [time, velocity]; it keeps the last one"));
  a->Field("fourier", &fourier,
           {.meaning = "a sum of harmonics, its coefficients drawn for each realization"});
  a->Field("moves", &moves, {.meaning = "pick and place, its places drawn for each realization"});
  a->Field("start", &start,
           {.unit = "rad",
            .meaning = "position at time 0, with `corners` and `fourier`",
            .at_default = left_out});

  // one kind, with its own keys alone
  const int kinds = steady() + !phases.empty() + !corners.empty() + bool(fourier) + bool(moves);
  a->Check(kinds == 1, "", "a map with one of speeds, phases, corners, fourier and moves");
  const int ends_given = (hold > 0) + bool(travel.limits) + travel.joint_limits;
  a->Check(!steady() || ends_given == 1, "",
           "a map with one of hold: seconds, and travel: [lower, upper] or joint_limits");
  a->Check(steady() || (ends_given == 0 && !rests), "",
           "a map in which hold, travel and rests stand beside speeds alone");
  a->Check(start == 0 || !corners.empty() || fourier, "start",
           "absent but for corners and fourier");
  a->Check(CornersAscend(), "corners", "a list of [time, velocity] whose times ascend");
}

template <class A>
void MotionPhase::Serialize(A* a) {
  // {rest: s}, or a motion with its duration
  std::optional<double> rest, lasts;
  (motion ? lasts : rest) = duration;
  if (duration == 0) rest.reset();
  a->Field("rest", &rest,
           WithDefault("s", "length of a rest, in place of the other keys", kPositive));
  a->Field("duration", &lasts, WithDefault("s", "length of the phase", kPositive));
  Motion held = motion.value_or(Motion{});
  held.SerializeHeld(a);
  a->Check(rest.has_value() != lasts.has_value(), "", "a map with one of rest and duration, s");
  a->Check(!rest || (!held.steady() && held.hold == 0), "", "a rest without speeds and hold");
  a->Check(!lasts || (held.steady() && held.hold > 0), "", "a map with speeds and hold");
  duration = rest ? *rest : lasts.value_or(0);
  motion.reset();
  if (lasts) motion = held;
}

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

}  // namespace warmjoint
