// One recording as it warms: its level of friction and the guesses read off it, as in the paper's
// Fig. 4.
#pragma once

#include <warmjoint/friction.h>
#include <warmjoint/recording.h>

#include <optional>
#include <string>

#include "tools/figures/figure.h"

namespace warmjoint::figures {

/// Torque with its envelope, and the friction level c(t) with what GuessThermal (25) reads off it:
/// levels cold and settled, 63 % time, gain and time constant. truth: beside the guess, where
/// known. Nothing where there is no guess.
std::optional<Figure> MakeEnvelope(const std::string& what, const Measurements& measurements,
                                   const Selection& selection, const std::optional<Thermal>& truth);

}  // namespace warmjoint::figures
