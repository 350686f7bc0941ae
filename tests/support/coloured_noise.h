// Noise that remembers, for tests.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

#include "models/foundation/random_stream.h"

namespace warmjoint::test {

/// Stationary AR(1) noise of variance 1. [n]
inline Eigen::VectorXd Coloured(Eigen::Index n, double pole, std::uint64_t seed) {
  RandomStream random({seed, 0}, Stream::test);
  Eigen::VectorXd e(n);
  double last = random.Normal();
  for (Eigen::Index i = 0; i < n; ++i) {
    last = pole * last + std::sqrt(1 - pole * pole) * random.Normal();
    e[i] = last;
  }
  return e;
}

}  // namespace warmjoint::test
