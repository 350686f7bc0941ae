// Identifier `rls`: a nominal law online, by recursive least squares.
#pragma once

#include "identification/identifier.h"

namespace warmjoint::inline identification {

/// The linear parameters of a law, sample by sample, with a forgetting factor f: the answer is that
/// of weighted least squares with weight f^age, so that with f = 1 it is nominal-ls. All but the
/// thermal parameters are linear: with thermal_gain and thermal_time_constant given, the heat of the
/// measured losses, H |tau v| without gravity's, is taken off first, so that a friction that changes
/// does not spoil it. The trace holds the parameters at 50 moments of the recording.
/// Intervals as in uncertainty.h, for the weighted samples; with a warming they hold the noise that
/// comes through the heat, too (measured_heat.h).
Identifier Rls();

}  // namespace warmjoint::inline identification
