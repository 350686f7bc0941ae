// Names of parameters and colours of identifiers, the same in all pictures.
#pragma once

#include <cstddef>
#include <string>

#include "tools/figures/figure.h"

namespace warmjoint::figures {

/// Symbol of a parameter, as set in print: "τ" for thermal_time_constant, "k_{v}" for viscous.
std::string SymbolOf(const std::string& parameter);
/// "viscous, k_{v}".
std::string NameWithSymbol(const std::string& parameter);

/// Where a parameter stands when those of all laws, then those of warming, are listed; unknown ones
/// stand last.
std::size_t PlaceInLaws(const std::string& parameter);

/// The hue of an identifier, the same in every figure: fixed for those that come with the program.
Hue IdentifierHue(const std::string& identifier);

}  // namespace warmjoint::figures
