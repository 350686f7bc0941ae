// Identifier `kalman`: parameters and energy online, by a bank of extended Kalman filters.
#pragma once

#include "identification/identifier.h"

namespace warmjoint::inline identification {

/// Runs a KalmanBank over the recording, from knowing nothing of law, gain and time constant and
/// E(0) = 0: one pass is what a controller would know at the end. The bank's members lie 0.1 to 0.4
/// apart in ln tau, near enough to be right to about twice the Cramer-Rao bound. Each further pass
/// over the stored recording is linearised where the last one ended, until nothing moves: then the
/// answer is that of maximum likelihood.
///
/// Standard deviations and 95 % intervals as in uncertainty.h, from the exact Jacobian of the
/// closed loop; none after a single pass, which they would not hold for. not_converged where the
/// last pass moved a parameter by more than its standard deviation; not_identifiable as energy-ml.
/// The trace holds parameters and energy at 50 moments of the last pass.
Identifier Kalman();

}  // namespace warmjoint::inline identification
