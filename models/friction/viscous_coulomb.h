// Viscous and Coulomb friction, Eq. (2).
#pragma once

#include <warmjoint/friction.h>

#include <array>

#include "models/friction/parameter_rows.h"
#include "models/friction/sign.h"

namespace warmjoint {

/// F(v) = kv v + kc sign(v), Eq. (2). F(0) = 0.
struct ViscousCoulomb {
  static constexpr std::string_view name = "viscous_coulomb";
  static constexpr std::string_view equation = "(2) F = kv v + kc sign(v)";
  static constexpr PreSliding pre_sliding = PreSliding::elastoplastic;
  static constexpr bool level_at_any_speed = true;
  static constexpr std::array parameters{
      kViscousRow,
      kCoulombRow,
  };

  /// p: {kv, kc}; returns N.m or N, at any side and speed.
  template <typename T>
  static T Level(int, double, const T* p) {
    return p[1];
  }

  /// v: rad/s or m/s; p: {kv, kc}; returns N.m or N.
  template <typename T>
  static T Force(double v, const T* p) {
    return p[0] * v + p[1] * T(Sign(v));
  }
};

}  // namespace warmjoint
