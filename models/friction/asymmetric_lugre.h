// LuGre friction with a Coulomb level for each direction of motion.
#pragma once

#include <warmjoint/friction.h>

#include <array>

#include "models/friction/asymmetric.h"
#include "models/friction/bristle_course.h"
#include "models/friction/parameter_rows.h"
#include "models/friction/sliding_force.h"
#include "models/friction/stribeck.h"

namespace warmjoint {

/// LuGre's bristle (lugre.h), whose level g is that of AsymmetricStribeck with exponent 2 on the
/// side of motion; in steady sliding F(v) = kv v + g sign(v).
struct AsymmetricLuGre {
  static constexpr std::string_view name = "asymmetric_lugre";
  static constexpr std::string_view equation =
      "dz/dt = v - sigma0 |v| z/g, F = sigma0 z + sigma1 dz/dt + kv v; steady: "
      "asymmetric_stribeck, delta 2";
  static constexpr PreSliding pre_sliding = PreSliding::bristle;
  static constexpr std::array parameters{
      kViscousRow,          kCoulombPositiveRow,  kCoulombNegativeRow, kStaticRiseRow,
      kStribeckVelocityRow, kBristleStiffnessRow, kBristleDampingRow,
  };

  /// side: direction of motion, 1 or -1; speed: |v|; p: {kv, kc+, kc-, kr, vs, sigma0, sigma1};
  /// returns g, N.m or N.
  template <typename T>
  static T Level(int side, double speed, const T* p) {
    const T coulomb = Asymmetric::Level(side, speed, p);
    return StribeckLevel(speed, coulomb, T(coulomb + p[3]), p[4]);
  }

  /// Along a motion: a bristle that carries the load s = sigma0 z.
  template <typename T>
  using Course = BristleCourse<AsymmetricLuGre, T>;
  template <typename T>
  static LawBristle<T> BristleOf(const T* p) {
    return {p[5], p[6], p[0]};
  }

  /// Steady sliding. v: rad/s or m/s; p: {kv, kc+, kc-, kr, vs, sigma0, sigma1}; returns N.m or N.
  template <typename T>
  static T Force(double v, const T* p) {
    return SlidingForceOf<AsymmetricLuGre>(v, p);
  }
};

}  // namespace warmjoint
