// A joint with the Stribeck effect, and a motion that shows it.
#pragma once

#include "tests/support/warm_recording.h"

namespace warmjoint::test {

/// The joint of Table I, cold, with the Stribeck effect below some 0.1 rad/s.
inline Friction StribeckJoint() {
  return {"stribeck",
          {{"viscous", 5},
           {"coulomb", 15},
           {"static", 20},
           {"stribeck_velocity", 0.05},
           {"stribeck_exponent", 2}},
          {},
          0,
          1};
}

/// The same with a level of 15 N.m forwards and 12 N.m backwards.
inline Friction TwoLevelStribeckJoint() {
  return {"asymmetric_stribeck",
          {{"viscous", 5},
           {"coulomb_positive", 15},
           {"coulomb_negative", 12},
           {"static_rise", 5},
           {"stribeck_velocity", 0.05},
           {"stribeck_exponent", 2}},
          {},
          0,
          1};
}

/// Speeds from 0.005 to 1 rad/s, even in their logarithm, held for `hold` samples, of alternating
/// sign. n: samples.
inline Eigen::VectorXd SlowAndFast(Eigen::Index n, std::uint64_t seed, Eigen::Index hold = 20) {
  RandomStream random({seed, 0}, Stream::motion);
  Eigen::VectorXd velocity(n);
  double v = -1;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (i % hold == 0) v = std::copysign(0.005 * std::pow(200, random.Uniform(0, 1)), -v);
    velocity[i] = v;
  }
  return velocity;
}

}  // namespace warmjoint::test
