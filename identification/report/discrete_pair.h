// The warming by Eq. (22), beside its gain and time constant.
#pragma once

#include <warmjoint/estimate.h>

#include <Eigen/Core>
#include <vector>

#include "identification/inference/inference.h"

namespace warmjoint {

/// thermal_gain_discrete (ke) and thermal_pole (te) for a sampling interval h (s). Their standard
/// deviations follow those of (k, ln tau) to first order; the interval of te is that of ln tau, so
/// that it stays between 0 and 1; both reach as far as those of k and tau were widened. Without
/// intervals where k and tau have none.
std::vector<EstimatedParameter> DiscretePair(const Fit& fit, const Inference& inference, double h);

}  // namespace warmjoint
