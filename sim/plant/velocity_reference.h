// The velocity that a drive is asked to follow.
#pragma once

#include <vector>

#include "scenarios/motion.h"

namespace warmjoint::inline sim {

/// Piecewise linear velocity that carries out a plan: constant, and ramps between its segments.
/// A ramp leads its boundary, so that the drive has settled when the next segment begins; the
/// reference starts from rest before t = 0 for the same reason.
class VelocityReference {
 public:
  /// acceleration: of the ramps, rad/s^2 or m/s^2; settling: s that the drive takes after a ramp.
  /// A lead is cut to the length of its segment.
  VelocityReference(const std::vector<MotionSegment>& plan, double acceleration, double settling);

  /// Follows corners, from rest: where the first is not 0, a ramp leads it by the settling time.
  static VelocityReference Through(const std::vector<VelocityCorner>& corners, double acceleration,
                                   double settling);

  /// Time at which it begins, s; not above 0.
  double begin() const { return corners_.front().time; }
  /// Way travelled from begin() to 0, rad or m.
  double run_up() const;
  /// Velocity at a time that does not fall from call to call, rad/s or m/s.
  double Velocity(double time);
  /// Slope of the velocity at the time of the last call, rad/s^2 or m/s^2.
  double acceleration() const { return slope_; }

 private:
  VelocityReference() = default;

  std::vector<VelocityCorner> corners_;
  size_t next_ = 0;  // first corner not before the last time
  double slope_ = 0;
};

}  // namespace warmjoint::inline sim
