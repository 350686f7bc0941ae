// What the structure of a residual is called, and what to try against it.
#pragma once

#include <string>

#include "identification/adequacy/judge.h"

namespace warmjoint {

/// "position (period 0.0025 m): 1.3 N rms, 3.2 % of the friction, 54 % of the residual's variance".
std::string DescribeStructure(const Adequacy& adequacy, const Structure& structure,
                              const Measurements& measurements);

/// The law or identifier that can follow what the residual depends on: "try energy-ml". Names only
/// what is there.
std::string Remedy(const Structure& structure, const Identifier& identifier,
                   const IdentifierInput& input, const Estimate& estimate);

}  // namespace warmjoint
