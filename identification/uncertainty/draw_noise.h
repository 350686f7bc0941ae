// Noise as a model tells it.
#pragma once

#include "identification/uncertainty/noise_model.h"
#include "models/foundation/random_stream.h"

namespace warmjoint {

/// Courses of n samples each of stationary noise of that colour, in N.m or N, [n x courses]. What drives it is uniform:
/// its covariances are the model's, its higher moments are not.
Eigen::MatrixXd DrawNoise(const NoiseModel& noise, Eigen::Index n, Eigen::Index courses,
                          StartStream& stream);

}  // namespace warmjoint
