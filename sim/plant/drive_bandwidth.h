// How fast a velocity drive has to be, so that its joint reaches the speeds of a motion.
#pragma once

#include <vector>

#include "scenarios/motion.h"

namespace warmjoint::inline sim {

/// What a drive works against on its joint.
struct DriveTask {
  double inertia = 0;  // M, effective, kg.m^2 or kg
  double level = 0;    // L, the largest friction that holds the cold joint at rest, N.m or N
  double slope = 0;    // c, of friction over speed, N.m.s/rad or N.s/m
  double gravity = 0;  // K, steepest slope of gravity over the position, N.m/rad or N/m
};

/// The smallest bandwidth w, rad/s, at which a VelocityDrive reaches the speeds v of the segments in
/// 95 % of the time that they move; 0 where none moves.
///
/// A reversal steps friction by 2 L. The joint sticks until the drive has made up for it,
///   M (2 w v + w^2 v t) = 2 L,
/// and its error then decays from v by M e'' + (2 M w + c) e' + M w^2 e = 0: to 1 % after
/// 6.6 / w + 4.6 c / (M w^2). Together it takes
///   T(w) = 4.6 / w + b / w^2,   b = (2 L / v + 4.6 c) / M,   and 6.6 / w at least.
/// T is to end within the settling time that the reference leaves before a segment, 10 / w, so that
///   w >= b / 5.4,
/// and with 6.6 in place of 4.6 within a tenth of the segment's duration d, so that
///   w >= (6.6 + sqrt(6.6^2 + 0.4 b d)) / (0.2 d).
/// Gravity whose slope over the position is K grows by K v each second, which leaves an error of
/// K v / (M w^2), of 1 % where w = 10 sqrt(K / M).
double SufficientBandwidth(const DriveTask& task, const std::vector<MotionSegment>& segments);

/// The pieces at a constant speed between corners.
std::vector<MotionSegment> HoldsBetween(const std::vector<VelocityCorner>& corners);

}  // namespace warmjoint::inline sim
