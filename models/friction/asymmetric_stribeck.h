// The Stribeck effect with a Coulomb level for each direction of motion.
#pragma once

#include <warmjoint/friction.h>

#include <array>

#include "models/friction/asymmetric.h"
#include "models/friction/parameter_rows.h"
#include "models/friction/sliding_force.h"
#include "models/friction/stribeck.h"

namespace warmjoint {

/// F(v) = kv v + g sign(v),  g = kc + kr exp(-(|v| / vs)^delta) with kc of the direction of motion
/// as in Eq. (3), and the same rise kr = ks - kc and fall of it in both. F(0) = 0.
struct AsymmetricStribeck {
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

  /// v: rad/s or m/s; p: {kv, kc+, kc-, kr, vs, delta}; returns N.m or N.
  template <typename T>
  static T Force(double v, const T* p) {
    return SlidingForceOf<AsymmetricStribeck>(v, p);
  }
};

}  // namespace warmjoint
