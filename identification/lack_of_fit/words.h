// What the tests for lack of fit say: quantities, sizes, remedies.
#pragma once

#include <string>

#include "identification/lack_of_fit/examine.h"
#include "identification/lack_of_fit/table.h"

namespace warmjoint {

/// "position (period 0.0025 m): 1.3 N rms, 3.2 % of the friction, 54 % of the residual's variance".
std::string DescribeFinding(const Examination& examination, const Finding& finding,
                            const Measurements& measurements);

/// What to do where a start that was taken to be cold may have been warm.
std::string AgainstWarmStart(const Identifier& identifier);

}  // namespace warmjoint
