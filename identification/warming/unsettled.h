// Why a fit does not come to rest, as far as its recording tells.
#pragma once

#include <string>
#include <string_view>

#include "models/recording/measurements.h"

namespace warmjoint::inline identification {

/// What `check` finds that the recording lacks to tell `what` ("warm-up", "law stribeck"), with its
/// remedy; where it lacks nothing, a doubt about the torque column.
std::string WhyUnsettled(const Measurements& measurements, std::string_view what);

}  // namespace warmjoint::inline identification
