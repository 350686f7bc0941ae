// Viscous friction with a Coulomb level for each direction of motion, Eq. (3).
#pragma once

#include <warmjoint/friction.h>

#include <array>

#include "models/friction/parameter_rows.h"
#include "models/friction/sign.h"

namespace warmjoint {

/// F(v) = kv v + kc+ sign(max(0, v)) + kc- sign(min(0, v)), Eq. (3). F(0) = 0.
/// sign(min(0, v)) is -1 for v < 0, so kc- is positive for friction that opposes the motion.
struct Asymmetric {
  static constexpr std::string_view name = "asymmetric";
  static constexpr std::string_view equation =
      "(3) F = kv v + kc+ sign(max(0,v)) + kc- sign(min(0,v))";
  static constexpr PreSliding pre_sliding = PreSliding::elastoplastic;
  static constexpr bool level_at_any_speed = true;
  static constexpr std::array parameters{
      kViscousRow,
      kCoulombPositiveRow,
      kCoulombNegativeRow,
  };

  /// side: direction of motion, 1 or -1; p: {kv, kc+, kc-}; returns N.m or N, at any speed.
  template <typename T>
  static T Level(int side, double, const T* p) {
    return side > 0 ? p[1] : p[2];
  }

  /// v: rad/s or m/s; p: {kv, kc+, kc-}; returns N.m or N.
  template <typename T>
  static T Force(double v, const T* p) {
    return p[0] * v + p[1] * T(v > 0) - p[2] * T(v < 0);
  }
};

}  // namespace warmjoint
