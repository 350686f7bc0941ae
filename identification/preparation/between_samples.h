// How a joint moves between its samples, as far as its losses ask.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/recording/measurements.h"

namespace warmjoint {

/// Means from each sample to the next of its piece; of the last one |v| and v. rad/s or m/s
struct BetweenSamples {
  Eigen::VectorXd mean_speed;     // [N] of |v|
  Eigen::VectorXd loss_velocity;  // [N] of v^2 over that of |v|, with the sign of v at the sample
};

/// Viscous friction loses kv v^2 and Coulomb friction kc |v|, so that both means give the loss of a
/// force that is a straight line over speed. The velocity is a straight line between samples, which
/// turns where it passes 0. While the joint moves clearly one way, its way is that of the positions,
/// to which all is scaled: speeds that bend or jump between samples cost nothing. Where the
/// positions are not known or contradict the velocity by more than a factor of 2 they are not used.
/// A sample at rest has no friction of its own: the way until the next counts with that one.
/// pieces: of the log without gaps; clear: speed from which on a joint moves clearly, rad/s or m/s.
BetweenSamples MeansBetween(const Measurements& measurements,
                            const std::vector<SampleRange>& pieces, double clear);

}  // namespace warmjoint
