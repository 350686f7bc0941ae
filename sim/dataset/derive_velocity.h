// Velocity from positions.
#pragma once

#include <Eigen/Core>

namespace warmjoint {

/// Velocity of a sampled position: a zero-phase Butterworth low-pass (4th order, run forwards and
/// backwards) and central differences. time: [N] s, evenly spaced; position: [N] rad or m.
/// cutoff: Hz; above 0.4 of the sampling rate the filter is left out. Returns [N] rad/s or m/s.
Eigen::VectorXd DeriveVelocity(const Eigen::VectorXd& time, const Eigen::VectorXd& position,
                               double cutoff);

}  // namespace warmjoint
