// The friction laws: those that slide steadily wherever they move, Eqs. (1) to (4) and the Stribeck effect, those with a bristle
// of their own, which bends before it slides, and their one list, for code that is made anew for each law.
#pragma once

#include <warmjoint/friction.h>

#include <array>
#include <cmath>
#include <string_view>

#include "models/friction/bristle_state.h"
#include "models/friction/parameter_rows.h"
#include "models/friction/sign.h"

namespace warmjoint {

/// The force of a law that has a slope, whose first parameter is kv: F(v) = kv v + g sign(v) with the law's level g on the side
/// of motion; F(0) = 0. L: the law, with Level.
template <typename L>
struct SlidesAtLevel {
  /// v: rad/s or m/s; p: one value for each of the law's parameters; returns N.m or N.
  template <typename T>
  static T Force(double v, const T* p) {
    return p[0] * v + T(Sign(v)) * L::Level(Sign(v), std::abs(v), p);
  }
};

/// A law whose first parameter is its level at any side and speed, and which has no slope: F(v) = kc sign(v), F(0) = 0.
struct SlidesAtCoulomb {
  /// p: {kc, ...}; returns N.m or N.
  template <typename T>
  static T Level(int, double, const T* p) {
    return p[0];
  }

  /// v: rad/s or m/s; p: {kc, ...}; returns N.m or N.
  template <typename T>
  static T Force(double v, const T* p) {
    return p[0] * T(Sign(v));
  }
};

/// F(v) = kc sign(v), Eq. (1). F(0) = 0.
struct Coulomb : SlidesAtCoulomb {
  static constexpr std::string_view name = "coulomb";
  static constexpr std::string_view equation = "(1) F = kc sign(v)";
  static constexpr PreSliding pre_sliding = PreSliding::elastoplastic;
  static constexpr bool level_at_any_speed = true;
  static constexpr std::array parameters{
      kCoulombRow,
  };
};

/// F(v) = kv v + kc sign(v), Eq. (2). F(0) = 0.
struct ViscousCoulomb : SlidesAtLevel<ViscousCoulomb> {
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
};

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

/// Sliding as ViscousCoulomb. At rest F equals the load up to ks >= kc, Eq. (4); beyond it
/// the joint breaks away and slides until it stops again. The stop alone restores ks.
struct Stiction : ViscousCoulomb {
  static constexpr std::string_view name = "stiction";
  static constexpr std::string_view equation = "(4) F = kv v + kc sign(v); at rest the load, to ks";
  static constexpr PreSliding pre_sliding = PreSliding::breakaway;
  static constexpr std::array parameters{
      kViscousRow,
      kCoulombRow,
      kStaticRow,
  };

  /// What a joint at rest bears before it breaks away, N.m or N. p: {kv, kc, ks}.
  template <typename T>
  static T StaticLevel(int, const T* p) {
    return p[2];
  }
};

/// StribeckLevel with delta = 2, without a power.
template <typename T>
T StribeckLevel(double speed, const T& coulomb, const T& at_rest, const T& velocity) {
  using std::exp;
  if (speed == 0) return at_rest;
  // exp(-40) is beyond the last digit
  const T ratio = speed / velocity;
  const T square = ratio * ratio;
  if (square > T(40)) return coulomb;
  return coulomb + (at_rest - coulomb) * exp(-square);
}

/// Whether an exponent is 2 and stays 2: of a number with derivatives these vanish.
template <typename T>
bool StaysTwo(const T& exponent) {
  if constexpr (requires { exponent.a, exponent.v; }) {
    return exponent.a == 2 && (exponent.v.array() == 0).all();
  } else {
    return exponent == 2;
  }
}

/// g(|v|) = kc + (ks - kc) exp(-(|v| / vs)^delta); g(0) = ks. All N.m or N, |v| and vs rad/s or
/// m/s. Source: Armstrong-Helouvry, Dupont, Canudas de Wit, Automatica 30 (1994), Eq. (2).
template <typename T>
T StribeckLevel(double speed, const T& coulomb, const T& at_rest, const T& velocity,
                const T& exponent) {
  using std::exp;
  using std::pow;
  if (speed == 0) return at_rest;
  if (StaysTwo(exponent)) return StribeckLevel(speed, coulomb, at_rest, velocity);
  return coulomb + (at_rest - coulomb) * exp(-pow(T(speed) / velocity, exponent));
}

/// F(v) = kv v + g(|v|) sign(v) with g of StribeckLevel. F(0) = 0.
struct Stribeck : SlidesAtLevel<Stribeck> {
  static constexpr std::string_view name = "stribeck";
  static constexpr std::string_view equation =
      "F = kv v + g sign(v), g = kc + (ks - kc) exp(-(|v|/vs)^delta)";
  static constexpr PreSliding pre_sliding = PreSliding::elastoplastic;
  static constexpr std::array parameters{
      kViscousRow, kCoulombRow, kStaticRow, kStribeckVelocityRow, kStribeckExponentRow,
  };

  /// speed: |v|; p: {kv, kc, ks, vs, delta}; returns g, N.m or N.
  template <typename T>
  static T Level(int, double speed, const T* p) {
    return StribeckLevel(speed, p[1], p[2], p[3], p[4]);
  }
};

/// F(v) = kv v + g sign(v),  g = kc + kr exp(-(|v| / vs)^delta) with kc of the direction of motion
/// as in Eq. (3), and the same rise kr = ks - kc and fall of it in both. F(0) = 0.
struct AsymmetricStribeck : SlidesAtLevel<AsymmetricStribeck> {
  static constexpr std::string_view name = "asymmetric_stribeck";
  static constexpr std::string_view equation =
      "F = kv v + g sign(v), g = kc+ or kc- + kr exp(-(|v|/vs)^delta)";
  static constexpr PreSliding pre_sliding = PreSliding::elastoplastic;
  static constexpr std::array parameters{
      kViscousRow,    kCoulombPositiveRow,  kCoulombNegativeRow,
      kStaticRiseRow, kStribeckVelocityRow, kStribeckExponentRow,
  };

  /// side: direction of motion, 1 or -1; speed: |v|; p: {kv, kc+, kc-, kr, vs, delta}; returns g,
  /// N.m or N.
  template <typename T>
  static T Level(int side, double speed, const T* p) {
    const T coulomb = Asymmetric::Level(side, speed, p);
    return StribeckLevel(speed, coulomb, T(coulomb + p[3]), p[4], p[5]);
  }
};

/// dF/dt = sigma0 (v - |v| F / kc), which is LuGre without damping, Stribeck effect and slope; in
/// steady sliding F(v) = kc sign(v). Source: Dahl, Aerospace Corp. TOR-158 (1968), exponent 1.
struct Dahl : SlidesAtCoulomb {
  static constexpr std::string_view name = "dahl";
  static constexpr std::string_view equation = "dF/dt = sigma0 (v - |v| F / kc); steady: (1)";
  static constexpr PreSliding pre_sliding = PreSliding::bristle;
  static constexpr std::array parameters{
      kCoulombRow,
      kBristleStiffnessRow,
  };

  /// A bristle that carries F. p: {kc, sigma0}.
  template <typename T>
  static LawBristle<T> BristleOf(const T* p) {
    return {p[1], T(0), T(0)};
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

/// What a joint at rest bears before it slides, in N.m or N: the static level of laws that break
/// away, and the level of sliding of all others. side: 1 or -1; speed: rad/s or m/s.
template <typename L, typename T>
T HoldingLevelOf(int side, double speed, const T* p) {
  if constexpr (L::pre_sliding == PreSliding::breakaway) {
    return L::StaticLevel(side, p);
  } else {
    return L::Level(side, speed, p);
  }
}

/// Whether a law says of itself, by level_at_any_speed, that no level of it depends on the speed.
template <typename L>
concept LawAtAnySpeed = requires {
  L::level_at_any_speed;
};

/// Whether a law brings a bristle of its own, by BristleOf, which follows a motion as BristleState does.
template <typename L>
concept LawWithBristle = requires(const double* p) {
  L::BristleOf(p);
};

template <typename... L>
struct LawList {
  static_assert(((LawWithBristle<L> == (L::pre_sliding == PreSliding::bristle)) && ...),
                "a law with a bristle of its own needs BristleOf, and no other law has one");
};

/// All laws: a new one is a struct and its name here.
using AllLaws = LawList<Coulomb, ViscousCoulomb, Asymmetric, Stiction, Stribeck, AsymmetricStribeck,
                        Dahl, LuGre, AsymmetricLuGre>;

/// f.operator()<L>() of the law of a list that has that name; it must have one.
template <typename First, typename... Rest, typename F>
auto ForLawNamed(LawList<First, Rest...>, std::string_view name, const F& f) {
  if constexpr (sizeof...(Rest) > 0) {
    if (name != First::name) return ForLawNamed(LawList<Rest...>{}, name, f);
  }
  return f.template operator()<First>();
}

}  // namespace warmjoint
