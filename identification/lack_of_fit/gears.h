// The gear of a motor whose ripple a residual shows over the joint's angle.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace warmjoint {

/// Gears g from 30 to 160 that fit a residual, the likeliest first: it has waves that return k g times in a turn of the joint,
/// k = 1 to 20. None where chance explains them all.
///
/// y is the power of the residual at a frequency, summed over the m directions of motion, over its local median, in units in which
/// it is Gamma(m) distributed where there is no wave. Where there is one, it is 1 + s times as large, with the density
/// 1/(1 + s)^2 of its unknown strength s. The ratio of both densities is
///
///     R(y) = e^y gamma(m + 1, y)/y^(m + 1),   gamma: the lower incomplete gamma function,
///
/// and the score of a gear is the sum of log R over its k, each at most the logarithm of the number of waves that are looked at:
/// a wave that is there beyond doubt says which gears have it, and its strength says no more. All gears fit whose score
/// is below the best one by no more than chance explains.
/// Positions, rad, velocities, rad/s, and residuals: [n] of the same samples; step: of the log, s
std::vector<int> GearsOf(const Eigen::VectorXd& position, const Eigen::VectorXd& velocity,
                         const Eigen::VectorXd& residual, double step);

}  // namespace warmjoint
