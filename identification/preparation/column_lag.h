// Whether a velocity column is late, or has an offset, relative to the slope of its positions.
#pragma once

#include <warmjoint/recording.h>

#include <optional>
#include <string>

namespace warmjoint {

/// A velocity column v(t) = p'(t - lag) + offset of positions p.
struct ColumnAgainstSlope {
  double lag = 0, lag_error = 0;  // s; below 0: it leads, as one that holds until the next sample
  double offset = 0, offset_error = 0;  // rad/s or m/s
  double step = 0;                      // s, of the log
  double speed = 0;                     // rms, rad/s or m/s

  /// Whether it is late by a tenth of a sample or more, beyond chance.
  bool IsLate() const;
  /// Whether it has an offset of 1 % of the speed or more, beyond chance.
  bool IsOff() const;
};

/// Over windows of a few samples the integral of v is
///     integral - Delta p = -lag Delta v + offset T + share Delta p,
/// `share` for a column with a small scale error. Least squares with Huber's loss over windows without gaps; of several lengths
/// that with the smallest error of the lag is taken. So neither the noise of single samples nor a drift of the integral counts.
/// Nothing with fewer than 30 windows. Positions must have been logged.
std::optional<ColumnAgainstSlope> CompareColumn(const Measurements& measurements);

/// "the velocity column lags its positions by 12 ms (1.2 samples): ..."
std::string Describe(const ColumnAgainstSlope& column, JointKind joint);

}  // namespace warmjoint
