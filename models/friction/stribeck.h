// The Stribeck effect: friction falls with speed before viscous friction makes it rise.
#pragma once

#include <warmjoint/friction.h>

#include <array>
#include <cmath>

#include "models/friction/parameter_rows.h"
#include "models/friction/sliding_force.h"

namespace warmjoint {

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
struct Stribeck {
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

  /// v: rad/s or m/s; p: {kv, kc, ks, vs, delta}; returns N.m or N.
  template <typename T>
  static T Force(double v, const T* p) {
    return SlidingForceOf<Stribeck>(v, p);
  }
};

}  // namespace warmjoint
