// Joint maximum likelihood of law and warming with maps over the joint's or the motor's angle.
#pragma once

#include "identification/identifier.h"

namespace warmjoint::inline identification {

/// law, position=none|map|motor, and what says how the maps are made.
std::vector<OptionInfo> WarmMapOptions();

/// Law, warming and the maps that the option `position` names, together. Refuses options that
/// cannot be had with maps: gravity, an estimated E(0), Huber's loss.
Fit FitWithMaps(const std::string& identifier, const IdentifierInput& input);

}  // namespace warmjoint::inline identification
