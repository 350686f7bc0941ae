// The speeds at which an answer reports its friction.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace warmjoint {

/// Samples of about the same speed in one direction.
struct SpeedGroup {
  double velocity = 0;  // their mean, rad/s or m/s; below 0: backwards
  std::vector<Eigen::Index> samples;
};

/// A low, the median and a high speed of each direction, forwards first: those about which the samples gather, within a fifth,
/// that are at 5, 50 and 95 % of |v|. Speeds that are near each other count once: a joint that moves at one speed has one.
/// velocity: [n] rad/s or m/s of the samples that count
std::vector<SpeedGroup> TypicalSpeeds(const Eigen::VectorXd& velocity);

/// Mean |load| of each group's samples, 0 of a friction that does not grow with it. load: [n] N.m or N; or empty
std::vector<double> MeanLoads(const std::vector<SpeedGroup>& groups, const Eigen::VectorXd& load);

}  // namespace warmjoint
