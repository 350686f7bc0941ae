// Why a fit does not come to rest, as far as its recording tells.
#pragma once

#include <string>

#include "identification/preparation/check.h"

namespace warmjoint::inline identification {

/// What `check` finds that the recording lacks to show friction of that kind, with its remedy; where it
/// lacks nothing, a doubt about the torque column.
std::string WhyUnsettled(const Measurements& measurements, FrictionKind kind);

}  // namespace warmjoint::inline identification
