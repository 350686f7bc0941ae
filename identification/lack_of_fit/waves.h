// Cosines and sines of angles.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace warmjoint {

/// cos and sin of angles. [m x 2]
inline Eigen::MatrixXd Waves(const Eigen::ArrayXd& angles) {
  Eigen::MatrixXd waves(angles.size(), 2);
  for (Eigen::Index i = 0; i < angles.size(); ++i) {
    // of one number, so that both come out of one call
    const double angle = angles[i];
    waves(i, 0) = std::cos(angle);
    waves(i, 1) = std::sin(angle);
  }
  return waves;
}

}  // namespace warmjoint
