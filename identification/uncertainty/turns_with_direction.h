// Whether a residual is friction that a model lacks, or noise of the torque.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace warmjoint {

/// Whether a residual turns with the direction of motion, as what a model of friction lacks does and
/// noise of the torque does not: the means of runs of one direction differ in sign from run to run
/// more often than half of the times, by more than three deviations (a sign test). Nothing where
/// fewer than nine changes of direction cannot tell. residual, velocity: [n]
std::optional<bool> TurnsWithDirection(const Eigen::VectorXd& residual,
                                       const Eigen::VectorXd& velocity);

}  // namespace warmjoint
