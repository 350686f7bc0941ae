// Noise, resolution and accelerations of a velocity signal, estimated from the signal itself.
#pragma once

#include <warmjoint/recording.h>

namespace warmjoint {

/// Scales that distinguish a constant speed from an acceleration, read from the log, so that no threshold
/// has a unit.
struct VelocityScale {
  // the largest distance of a sample from a speed; the largest of noise, share and resolution counts
  static constexpr double kFar = 4;       // deviations of the noise: 1 in 16 000 lies further
  static constexpr double kNear = 3;      // the same for samples at rest, or settled ones: 1 in 370
  static constexpr double kBand = 0.02;   // of the speed: the allowed deviation of a hold
  static constexpr double kLevels = 1.5;  // steps of a quantised velocity: to the neighbouring one

  double rms = 0;         // root mean square of the velocity, rad/s or m/s
  double noise = 0;       // standard deviation around constant speeds, rad/s or m/s
  double memory = 1;      // samples after which that noise is no longer correlated
  double resolution = 0;  // step of a quantised velocity, rad/s or m/s; 0 where it is not quantised
  double steepest = 0;    // largest acceleration, rad/s^2 or m/s^2
  double step = 0;        // median time between samples, s

  /// How far samples of a constant speed `level` may lie from it: 4 noise, 2 % of the level, or 1.5
  /// resolutions, whichever is most. rad/s or m/s.
  double Band(double level) const;
  /// Largest speed that counts as rest: 3 noise, 1.5 resolutions, or a thousandth of rms, whichever
  /// is most. rad/s or m/s.
  double Rest() const;
};

/// noise: differences of the velocity over 1, 2, 4, ... samples spread more and more until the lag
/// exceeds the memory of the noise; there they stop spreading, and that spread is the noise. It is
/// read from the 35 % quantile, so that up to half of the samples may accelerate or jump. Where it
/// never stops (a sinusoid), or only above 5 % of rms, the spread over one sample is taken.
/// resolution: the common divisor of the steps, where the signal toggles between neighbours.
/// steepest: largest difference over 2, 4, 8, ... samples less 6 noise; single outliers do not
/// count.
VelocityScale MeasureVelocity(const Measurements& measurements);

}  // namespace warmjoint
