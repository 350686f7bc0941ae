// The change from one constant speed to the next, as the positions show it.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>

#include "identification/preparation/position_noise.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint {

/// A straight line by least squares, x(t) = value + slope (t - time): positions of one constant speed, or its velocities.
struct StraightLine {
  double time = 0;   // s, mean of its samples
  double value = 0;  // there
  double slope = 0;  // 1/s
  double samples = 0;
  double spread = 0;     // sum of squares of the samples' times around their mean, s^2
  double deviation = 0;  // of the samples around it

  double At(double t) const { return value + slope * (t - time); }
  /// Standard error of At(t).
  double ErrorAt(double t) const;
};

/// Through the samples first, ..., last of `use`. time: [N] s; values: [N]. Nothing for fewer than two samples.
std::optional<StraightLine> FitStraightLine(const Eigen::VectorXd& time,
                                            const Eigen::VectorXd& values, Eigen::Index first,
                                            Eigen::Index last, const SampleMask& use);

/// A change of speed at a constant acceleration around a time, a jump where its duration is 0.
struct SpeedChange {
  StraightLine before, behind;
  double time = 0;      // s, of its middle: where the two lines cross
  double duration = 0;  // s
  double margin = 0;    // s at each end, within which a sample may belong to it

  /// By how much the speed changes, rad/s or m/s.
  double Leap() const { return std::abs(behind.slope - before.slope); }
  double begin() const { return time - duration / 2; }
  double end() const { return time + duration / 2; }
  /// Position at t, rad or m.
  double At(double t) const;
};

/// The change of speed between two lines. Where they cross is its middle, whatever its duration D:
///
///     p(t) = before(t) + (v1 - v0) / (2 D) (t - begin)^2  within, before(t) and behind(t) outside.
///
/// D is searched on a grid, then by golden section, and stays 0 unless that lowers the squares by
/// 4 deviations^2. margin: the largest of sqrt(2 reach D / |v1 - v0|) / 2 (the start of a ramp is hidden
/// by the error of the positions), reach / |v1 - v0| and four standard errors of the crossing (within which
/// a jump is hidden), plus a tenth of D. Nothing where the speeds differ by less than 1 % of the
/// greater, the lines cross outside of the samples first, ..., last, or one of these samples lies
/// further from p(t) than noise.reach and three standard errors of its line: then the speed changes
/// in another way.
std::optional<SpeedChange> FindSpeedChange(const Eigen::VectorXd& time,
                                           const Eigen::VectorXd& position,
                                           const StraightLine& before, const StraightLine& behind,
                                           Eigen::Index first, Eigen::Index last,
                                           const PositionNoise& noise);

}  // namespace warmjoint
