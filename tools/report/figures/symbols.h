// Names of parameters in pictures: one name and one symbol for each.
#pragma once

#include <cstddef>
#include <string>

namespace warmjoint::report {

/// Symbol of a parameter, as set in print: "τ" for thermal_time_constant, "k_{v}" for viscous.
std::string SymbolOf(const std::string& parameter);
/// "viscous, k_{v}".
std::string NameWithSymbol(const std::string& parameter);

/// Where a parameter stands when those of all laws, then those of warming, are listed; unknown ones
/// stand last.
std::size_t PlaceInLaws(const std::string& parameter);

}  // namespace warmjoint::report
