// The heat that a joint has at the end of its log.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/prepared_log.h>

#include <vector>

#include "identification/fit.h"
#include "identification/inference/inference.h"

namespace warmjoint {

/// E at the log's last sample, N.m or N: `energy`, and `second_energy` of a second stage; before
/// them the stamp of that sample, `time`, s, where the log is one recording. Along the
/// motion with the friction that is reported; the interval follows from the parameters' covariance
/// by the fit's own slopes, or central differences where it has none, and reaches farther by what
/// the verdict widened them. Empty where nothing warms.
std::vector<EstimatedParameter> EndState(const Fit& fit, const Inference& inference,
                                         const Friction& friction, const LogSamples& measurements);

}  // namespace warmjoint
