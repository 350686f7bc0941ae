// When an answer counts as confidently wrong.
#pragma once

#include <warmjoint/score.h>

#include <array>

namespace warmjoint {

inline constexpr double kIntervalWidth = 3.92;  // deviations of a 95 % interval of known variance
inline constexpr double kFarDeviations = 3;     // beyond an end of it

/// Whether the truth lies more than three deviations (interval / 3.92) beyond an end of the interval.
inline bool IsFarOutside(const ParameterScore& one, const std::array<double, 2>& interval) {
  const double deviation = (interval[1] - interval[0]) / kIntervalWidth;
  return one.truth < interval[0] - kFarDeviations * deviation ||
         one.truth > interval[1] + kFarDeviations * deviation;
}

}  // namespace warmjoint
