// Maps whose weights go together from kernel to kernel.
#pragma once

#include <warmjoint/friction.h>

#include <Eigen/Core>
#include <vector>

namespace warmjoint {

/// Correlation of the weights of maps, one map's after the other's, those `unseen` left out, as if independent ones
/// had been smeared along each line of the first axis by a Gaussian of `length` / sqrt(2) spacings: far from the ends
/// exp(-d^2 / (2 length^2)) at d kernels' distance; 0 between lines. length > 0; returns [s x s] of the s seen ones.
Eigen::MatrixXd CorrelationInLines(const std::vector<FrictionMap>& maps,
                                   const std::vector<bool>& unseen, double length);

}  // namespace warmjoint
