// What the structure of a residual is called, and what to try against it.
#pragma once

#include <string>

#include "identification/adequacy/examine.h"
#include "identification/identifier.h"

namespace warmjoint::inline identification {

/// "position (period 0.0025 m): 1.3 N rms, 3.2 % of the friction, 54 % of the residual's variance".
std::string DescribeStructure(const Adequacy& adequacy, const Structure& structure,
                              const Measurements& measurements);

/// What to do where a start that was taken to be cold may have been warm.
std::string AgainstWarmStart(const Identifier& identifier, const IdentifierInput& input);

/// The law or identifier that can follow what the residual depends on: "try energy-ml". Names only
/// what is there.
std::string Remedy(const Structure& structure, const Identifier& identifier,
                   const IdentifierInput& input, const Fit& fit);

}  // namespace warmjoint::inline identification
