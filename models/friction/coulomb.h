// Coulomb friction, Eq. (1).
#pragma once

#include <warmjoint/friction.h>

#include <array>

#include "models/friction/parameter_rows.h"
#include "models/friction/sign.h"

namespace warmjoint {

/// F(v) = kc sign(v), Eq. (1). F(0) = 0.
struct Coulomb {
  static constexpr std::string_view name = "coulomb";
  static constexpr std::string_view equation = "(1) F = kc sign(v)";
  static constexpr PreSliding pre_sliding = PreSliding::elastoplastic;
  static constexpr bool level_at_any_speed = true;
  static constexpr std::array parameters{
      kCoulombRow,
  };

  /// p: {kc}; returns N.m or N, at any side and speed.
  template <typename T>
  static T Level(int, double, const T* p) {
    return p[0];
  }

  /// v: rad/s or m/s; p: {kc}; returns N.m or N.
  template <typename T>
  static T Force(double v, const T* p) {
    return p[0] * T(Sign(v));
  }
};

}  // namespace warmjoint
