// Laws with a bristle of their own, which bends before it slides.
#pragma once

#include <warmjoint/friction.h>

#include <array>

#include "models/friction/bristle_course.h"
#include "models/friction/parameter_rows.h"
#include "models/friction/sign.h"
#include "models/friction/steady_laws.h"

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

  /// A bristle that carries F.
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

/// dz/dt = v - sigma0 |v| z / g(|v|),  F = sigma0 z + sigma1 dz/dt + kv v, with g of StribeckLevel
/// and exponent 2; in steady sliding F(v) = kv v + g sign(v).
/// Source: Canudas de Wit, Olsson, Astrom, Lischinsky, IEEE Trans. Automatic Control 40 (1995).
struct LuGre : SlidesAtLevel<LuGre> {
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

  /// A bristle that carries the load s = sigma0 z.
  template <typename T>
  static LawBristle<T> BristleOf(const T* p) {
    return {p[4], p[5], p[0]};
  }
};

/// LuGre's bristle, whose level g is that of AsymmetricStribeck with exponent 2 on the
/// side of motion; in steady sliding F(v) = kv v + g sign(v).
struct AsymmetricLuGre : SlidesAtLevel<AsymmetricLuGre> {
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

  /// A bristle that carries the load s = sigma0 z.
  template <typename T>
  static LawBristle<T> BristleOf(const T* p) {
    return {p[5], p[6], p[0]};
  }
};

}  // namespace warmjoint
