// How the samples of a recording lie in time.
#pragma once

#include <Eigen/Core>

#include "models/foundation/robust_noise.h"

namespace warmjoint::inline models {

// The sampling interval of a recording is its median step throughout (MedianStep): gaps and jitter
// leave that as it is.

/// A step of more than this many sampling intervals is a gap: at least three samples in a row are
/// missing, which jitter and a lost sample or two do not make.
inline constexpr double kGapSteps = 3;

/// The longest step between samples that is no gap, s. time: [N] s, N at least 2.
inline double LongestStep(const Eigen::VectorXd& time) { return kGapSteps * MedianStep(time); }

}  // namespace warmjoint::inline models
