// Identifier `kalman`: parameters and energy online, by an extended Kalman filter.
#pragma once

#include "identification/identifier.h"

namespace warmjoint {

/// Runs KalmanStep over the recording, from start_gain and start_time_constant known to a factor of
/// e or so, and E(0) = 0. One pass is what a controller would know at the end; the filter is
/// linearised where it stands, so that further passes over a stored recording, each from where the
/// last one ended and as ignorant, come nearer to energy-ml. The variance of the noise is taken
/// from the residual of the pass before (the first: of plain least squares).
/// Intervals as in uncertainty.h, from the closed loop's Jacobian. not_converged where the last of
/// several passes still moves a parameter by more than its standard deviation. The trace holds the
/// parameters at 50 moments of the last pass.
Identifier Kalman();

}  // namespace warmjoint
