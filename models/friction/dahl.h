// Dahl friction: Coulomb friction that a spring approaches with travel.
#pragma once

#include <warmjoint/friction.h>

#include <array>

#include "models/friction/bristle_course.h"
#include "models/friction/parameter_rows.h"
#include "models/friction/sign.h"

namespace warmjoint {

/// dF/dt = sigma0 (v - |v| F / kc), which is LuGre without damping, Stribeck effect and slope; in
/// steady sliding F(v) = kc sign(v). Source: Dahl, Aerospace Corp. TOR-158 (1968), exponent 1.
struct Dahl {
  static constexpr std::string_view name = "dahl";
  static constexpr std::string_view equation = "dF/dt = sigma0 (v - |v| F / kc); steady: (1)";
  static constexpr PreSliding pre_sliding = PreSliding::bristle;
  static constexpr std::array parameters{
      kCoulombRow,
      kBristleStiffnessRow,
  };

  /// p: {kc, sigma0}; returns N.m or N, at any side and speed.
  template <typename T>
  static T Level(int, double, const T* p) {
    return p[0];
  }

  /// Along a motion: a bristle that carries F.
  template <typename T>
  using Course = BristleCourse<Dahl, T>;
  template <typename T>
  static LawBristle<T> BristleOf(const T* p) {
    return {p[1], T(0), T(0)};
  }

  /// Steady sliding. v: rad/s or m/s; p: {kc, sigma0}; returns N.m or N.
  template <typename T>
  static T Force(double v, const T* p) {
    return p[0] * T(Sign(v));
  }
};

}  // namespace warmjoint
