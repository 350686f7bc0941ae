// Velocity from positions.
#pragma once

#include <Eigen/Core>

namespace warmjoint {

/// Velocity of a sampled position: a zero-phase Butterworth low-pass (4th order, run forwards and
/// backwards) and central differences. Pieces between gaps (more than three median steps) are
/// treated one by one. A piece whose steps differ by more than 1 % is put on an even grid of its
/// mean step by straight lines, filtered there, and read back at its own times. time: [N] s,
/// increasing; position: [N] rad or m. cutoff: Hz; above 0.4 of the sampling rate the filter is
/// left out. Returns [N] rad/s or m/s.
Eigen::VectorXd DeriveVelocity(const Eigen::VectorXd& time, const Eigen::VectorXd& position,
                               double cutoff);

/// A cutoff for DeriveVelocity, in Hz: 100 Hz, which passes what a joint's controller does, or less
/// where the noise of the position would otherwise drown its slope. White noise of standard
/// deviation s on the position leaves sqrt(h (2 pi)^2 2/3 fc^3) s on the velocity (h: step, s);
/// the cutoff is lowered until that is 1 % of the velocity's root mean square, at most to 0.02 of
/// the sampling rate. s comes from the median of the position's fourth differences, or from its
/// resolution (smallest step / sqrt(12)) where that is more.
double ChooseCutoff(const Eigen::VectorXd& time, const Eigen::VectorXd& position);

}  // namespace warmjoint
