// Normalised kernels beside plain ones, as data.
#pragma once

#include "tools/shown/shown_data.h"

namespace warmjoint::shown {

/// 0.3 t^2 - 0.5 seen with noise between -2 and 2, and what ridge regression makes of it with plain (10)-(13) and with normalised (16)
/// kernels, beyond the data too: {reach, t, truth, seen, values, fits{plain, normalised}, kernels{plain, normalised [t x K]}}.
Tree KernelFacts(ShownData& data);

}  // namespace warmjoint::shown
