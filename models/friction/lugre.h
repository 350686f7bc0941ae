// LuGre friction: bristles that bend before they slide, with the Stribeck effect.
#pragma once

#include <warmjoint/friction.h>

#include <array>

#include "models/friction/bristle_course.h"
#include "models/friction/parameter_rows.h"
#include "models/friction/sliding_force.h"
#include "models/friction/stribeck.h"

namespace warmjoint {

/// dz/dt = v - sigma0 |v| z / g(|v|),  F = sigma0 z + sigma1 dz/dt + kv v, with g of StribeckLevel
/// and exponent 2; in steady sliding F(v) = kv v + g sign(v).
/// Source: Canudas de Wit, Olsson, Astrom, Lischinsky, IEEE Trans. Automatic Control 40 (1995).
struct LuGre {
  static constexpr std::string_view name = "lugre";
  static constexpr std::string_view equation =
      "dz/dt = v - sigma0 |v| z/g, F = sigma0 z + sigma1 dz/dt + kv v; steady: stribeck, delta 2";
  static constexpr PreSliding pre_sliding = PreSliding::bristle;
  static constexpr std::array parameters{
      kViscousRow,          kCoulombRow,          kStaticRow,
      kStribeckVelocityRow, kBristleStiffnessRow, kBristleDampingRow,
  };

  /// speed: |v|; p: {kv, kc, ks, vs, sigma0, sigma1}; returns g, N.m or N.
  template <typename T>
  static T Level(int, double speed, const T* p) {
    return StribeckLevel(speed, p[1], p[2], p[3]);
  }

  /// Along a motion: a bristle that carries the load s = sigma0 z.
  template <typename T>
  using Course = BristleCourse<LuGre, T>;
  template <typename T>
  static LawBristle<T> BristleOf(const T* p) {
    return {p[4], p[5], p[0]};
  }

  /// Steady sliding. v: rad/s or m/s; p: {kv, kc, ks, vs, sigma0, sigma1}; returns N.m or N.
  template <typename T>
  static T Force(double v, const T* p) {
    return SlidingForceOf<LuGre>(v, p);
  }
};

}  // namespace warmjoint
