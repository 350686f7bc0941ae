// The force of steady sliding of laws with a slope and a level that may depend on speed.
#pragma once

#include <cmath>

#include "models/friction/sign.h"

namespace warmjoint {

/// F(v) = kv v + g sign(v) with the law's level g on the side of motion; F(0) = 0.
/// L: a law with Level whose first parameter is kv; v: rad/s or m/s; returns N.m or N.
template <typename L, typename T>
T SlidingForceOf(double v, const T* p) {
  return p[0] * v + T(Sign(v)) * L::Level(Sign(v), std::abs(v), p);
}

}  // namespace warmjoint
