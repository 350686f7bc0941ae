// Recordings of a joint that warms, made without any scenario.
#pragma once

#include <cmath>

#include "models/foundation/random_stream.h"
#include "models/recording/measurements.h"
#include "tests/support/vectors.h"

namespace warmjoint::test {

/// Table I of the paper.
inline Friction TableOne() {
  return {"viscous_coulomb", {{"viscous", 5}, {"coulomb", 15}}, Thermal{-3, 600}, 0, 1};
}

/// Speeds drawn from U(0.1, 1) rad/s, held for 20 s at 1 s a sample, of alternating sign.
/// n: samples; rest: every other span of so many samples is at rest (0: none).
inline Eigen::VectorXd AlternatingSpeeds(Eigen::Index n, std::uint64_t seed,
                                         Eigen::Index rest = 0) {
  RandomStream random({seed, 0}, Stream::motion);
  Eigen::VectorXd velocity(n);
  double v = -1;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (i % 20 == 0) v = std::copysign(random.Uniform(0.1, 1), -v);
    velocity[i] = rest > 0 && i / rest % 2 == 1 ? 0.0 : v;
  }
  return velocity;
}

/// What `friction` gives along a motion, with white noise. step: s; velocity: [N] rad/s;
/// noise: standard deviation, N.m.
inline Measurements RecordFriction(const Friction& friction, double step,
                                   const Eigen::VectorXd& velocity, double noise,
                                   std::uint64_t seed) {
  Measurements m = Record(step, velocity, Eigen::VectorXd::Zero(velocity.size()));
  m.torque = PredictFriction(friction, m).force;
  RandomStream random({seed, 0}, Stream::torque_noise);
  for (double& torque : m.torque) torque += noise * random.Normal();
  return m;
}

}  // namespace warmjoint::test
