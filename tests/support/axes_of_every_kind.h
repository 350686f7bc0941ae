// Axes of every kind that maps have.
#pragma once

#include <warmjoint/friction.h>

#include <numbers>
#include <vector>

namespace warmjoint::test {

inline constexpr double kTurn = 2 * std::numbers::pi;

inline GaussianAxis Wide(GaussianAxis axis, double factor) {
  axis.width *= factor;
  return axis;
}

inline GaussianAxis UnevenAxis() {
  GaussianAxis axis;
  axis.centres = {-2, -0.5, 0.1, 0.2, 3};
  axis.width = 0.4;
  return axis;
}

inline std::vector<GaussianAxis> AxesOfEveryKind() {
  return {EvenAxis(-3, 3, 40),   EvenAxis(-3, 3, 1),   Wide(EvenAxis(-3, 3, 12), 4),
          CircleAxis(kTurn, 36), CircleAxis(kTurn, 7), Wide(CircleAxis(kTurn, 8), 3),
          SpeedAxis(0.2, 2, 3),  SpeedAxis(0.2, 2, 5), SpeedAxis(0.2, 2, 1),
          UnevenAxis()};
}

}  // namespace warmjoint::test
