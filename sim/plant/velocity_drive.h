// How a simulated joint is driven: its velocity controller, the velocity asked for, and whether it follows.
#pragma once

#include <cmath>
#include <vector>

#include "scenarios/motion.h"

namespace warmjoint {

/// PI control of velocity with feedforward of the inertia:
///   torque = M a_ref + kp e + ki integral(e),  e = v_ref - v,  kp = 2 M w,  ki = M w^2,
/// which places both poles of the closed loop at the bandwidth w.
class VelocityDrive {
 public:
  /// inertia: M, kg.m^2 or kg; bandwidth: w, rad/s; h: step, s.
  VelocityDrive(double inertia, double bandwidth, double h)
      : inertia_(inertia),
        proportional_(2 * inertia * bandwidth),
        integral_(inertia * bandwidth * bandwidth * h) {}

  /// Torque of this step, N.m or N.
  double Torque(double reference, double acceleration, double velocity) {
    const double error = reference - velocity;
    sum_ += integral_ * error;
    return inertia_ * acceleration + proportional_ * error + sum_;
  }

 private:
  double inertia_;
  double proportional_;  // kp
  double integral_;      // ki h
  double sum_ = 0;       // ki integral(e)
};

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
  /// Distance travelled from begin() to 0, rad or m.
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

/// Counts, over equal steps, how often the joint moves within 5 % of a constant commanded speed.
class SpeedWatch {
 public:
  /// A step. wanted, velocity: rad/s or m/s; constant: whether the commanded speed stays as it is.
  void Look(double wanted, double velocity, bool constant) {
    if (!constant || wanted == 0) return;
    ++commanded_;
    reached_ += std::abs(velocity - wanted) <= 0.05 * std::abs(wanted);
  }

  /// Of the steps at a constant speed other than 0; 1 where there were none.
  double share() const {
    return commanded_ == 0 ? 1 : static_cast<double>(reached_) / static_cast<double>(commanded_);
  }

 private:
  long commanded_ = 0;
  long reached_ = 0;
};

}  // namespace warmjoint
