// The last step: a fit and what is inferred from it, with names and units.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/prepared_log.h>

#include "identification/inference/inference.h"

namespace warmjoint {

/// The estimate: parameters by name with their intervals; beside the warming's gain and time
/// constant the discrete pair of Eq. (22) for the median sampling interval; metrics, trace, friction,
/// gravity, bands and the covariance of the values. measurements: what the fit saw.
Estimate ReportFit(const Fit& fit, const Inference& inference, const PreparedLog& log,
                   const LogSamples& measurements);

/// The fit's friction with what the causes moved.
Friction ReportedFriction(const Fit& fit, const Inference& inference);

}  // namespace warmjoint
