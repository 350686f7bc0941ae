// The heat that a joint starts with, as attach is told.
#pragma once

#include <string>
#include <vector>

#include "models/friction/friction_description.h"

namespace warmjoint::inline tools {

/// E1 and E2, N.m or N, for `initial` (--initial of attach) and the friction of one file:
///   cold            empty
///   end             `state_end` of that estimate.json: the heat at the end of its recording
///   settled:SPEED   what sliding at SPEED, rad/s or m/s, settles at (SettledEnergy)
/// Throws BadInput for another text, a file without `state_end`, and a speed at which the losses
/// grow for ever.
std::vector<double> InitialEnergy(const std::string& initial, const FrictionDescription& friction,
                                  const std::string& file);

}  // namespace warmjoint::inline tools
