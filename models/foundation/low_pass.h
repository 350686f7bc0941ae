// A first-order low-pass of a sampled signal.
#pragma once

#include <Eigen/Core>

namespace warmjoint::inline models {

/// How much of a step a first-order low-pass has followed after `step` s: 1 - exp(-step / T).
double ShareFollowed(double step, double time_constant);

/// x behind a first-order low-pass that each sample's value drives until the next one:
/// y[0] = x[0], y[i] = y[i-1] + (1 - exp(-(t[i] - t[i-1]) / T)) (x[i-1] - y[i-1]).
/// time: [N] s, increasing; x: [N]; time_constant: T > 0, s.
Eigen::VectorXd LowPass(const Eigen::VectorXd& time, const Eigen::VectorXd& x,
                        double time_constant);

}  // namespace warmjoint::inline models
