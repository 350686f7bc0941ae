// The speeds at which an answer tells its friction.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace warmjoint {

/// Samples that move about as fast in one direction.
struct SpeedGroup {
  double velocity = 0;  // their mean, rad/s or m/s; below 0: backwards
  std::vector<Eigen::Index> samples;
};

/// A low, the median and a high speed of each direction, forwards first: those about which the samples gather, within a fifth,
/// that are at 5, 50 and 95 % of |v|. One that is near another stands once: a joint that knows one speed has one.
/// velocity: [n] rad/s or m/s of the samples that count
std::vector<SpeedGroup> TypicalSpeeds(const Eigen::VectorXd& velocity);

}  // namespace warmjoint
