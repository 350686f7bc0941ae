// Stiction: a joint at rest bears more than a sliding one, Eq. (4).
#pragma once

#include <warmjoint/friction.h>

#include <array>

#include "models/friction/parameter_rows.h"
#include "models/friction/sign.h"

namespace warmjoint {

/// Sliding, F(v) = kv v + kc sign(v). At rest F equals the load up to ks >= kc, Eq. (4); beyond it
/// the joint breaks away and slides until it stops again. The stop alone restores ks.
struct Stiction {
  static constexpr std::string_view name = "stiction";
  static constexpr std::string_view equation = "(4) F = kv v + kc sign(v); at rest the load, to ks";
  static constexpr PreSliding pre_sliding = PreSliding::breakaway;
  static constexpr bool level_at_any_speed = true;
  static constexpr std::array parameters{
      kViscousRow,
      kCoulombRow,
      kStaticRow,
  };

  /// p: {kv, kc, ks}; returns N.m or N, of sliding at any side and speed.
  template <typename T>
  static T Level(int, double, const T* p) {
    return p[1];
  }

  /// What a joint at rest bears before it breaks away, N.m or N.
  template <typename T>
  static T StaticLevel(int, const T* p) {
    return p[2];
  }

  /// v: rad/s or m/s; p: {kv, kc, ks}; returns N.m or N.
  template <typename T>
  static T Force(double v, const T* p) {
    return p[0] * v + p[1] * T(Sign(v));
  }
};

}  // namespace warmjoint
