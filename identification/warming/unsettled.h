// Why a fit does not come to rest, as far as its recording tells.
#pragma once

#include <string>
#include <string_view>

#include "sim/dataset/measurements.h"

namespace warmjoint {

/// What `check` finds that the recording lacks to tell `what` ("warm-up", "law stribeck"), with its
/// remedy; where it lacks nothing, a doubt about the torque column.
std::string WhyUnsettled(const Measurements& measurements, std::string_view what);

}  // namespace warmjoint
