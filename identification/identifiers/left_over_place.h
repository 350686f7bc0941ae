// Whether a residual still holds what a map could take.
#pragma once

#include <Eigen/Core>

#include "identification/forward/map_points.h"

namespace warmjoint {

/// Whether means over bins of place, one set for each direction of motion, take more of a residual
/// than chance would, at any of six widths of 8 to 256 bins:
///     (S0 - S1) / s^2 > k + 2 sqrt(2 k),   s^2 = S1 / (n - k - 1),
/// S0: squares about one mean, S1: squares about the k + 1 means of bins that hold samples. Under chance
/// alone the left side is k F, k on average, give or take sqrt(2 k). Kernels are no freer than such
/// means, and a map that takes no more than chance gives does not lower the error on what it has not seen.
/// residual: [n] N.m or N; points: [n x 5]. Places are the joint's position, and the motor's angle.
bool LeavesOverPlace(const Eigen::VectorXd& residual, const MapPoints& points);

}  // namespace warmjoint
