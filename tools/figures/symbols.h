// How pictures write numbers, units and parameters, and the look of each identifier, the same in all.
#pragma once

#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>

#include "tools/figures/figure.h"

namespace warmjoint::figures {

/// A number as a person writes it, with `digits` significant digits: true minus sign, and 5·10⁻⁵ below
/// 0.001 or from 100 000 on.
std::string SignificantText(double value, int digits = 3);

/// A unit as set in print: "N·m·s²/rad" for "N.m.s^2/rad".
std::string UnitText(std::string_view unit);

/// Symbol of a parameter, as set in print: "τ" for thermal_time_constant, "k_{v}" for viscous.
std::string SymbolOf(const std::string& parameter);
/// "viscous, k_{v}".
std::string NameWithSymbol(const std::string& parameter);

/// Where a parameter stands when those of all laws, then those of warming, are listed; unknown ones
/// stand last.
std::size_t PlaceInLaws(const std::string& parameter);

/// The hue of an identifier, the same in every figure: fixed for those that come with the program.
Hue IdentifierHue(const std::string& identifier);

// Rows of one identifier share its colour, and so do a few identifiers; strokes and markers tell them apart.

/// How many rows before rows[place] have the same colour.
template <typename Rows>
std::size_t EarlierOfSame(const Rows& rows, std::size_t place) {
  const Hue hue = IdentifierHue(rows[place].identifier);
  std::size_t earlier = 0;
  for (std::size_t i = 0; i < place; ++i) earlier += IdentifierHue(rows[i].identifier) == hue;
  return earlier;
}

/// The stroke of a colour's first, second, ... row.
template <typename Rows>
Dash DashOf(const Rows& rows, std::size_t place) {
  static constexpr Dash kOrder[] = {Dash::solid, Dash::dashed, Dash::dotted};
  return kOrder[EarlierOfSame(rows, place) % std::size(kOrder)];
}

/// The marker of a colour's first, second, ... row.
template <typename Rows>
Marker MarkerOf(const Rows& rows, std::size_t place) {
  static constexpr Marker kOrder[] = {Marker::circle, Marker::square, Marker::diamond, Marker::up};
  return kOrder[EarlierOfSame(rows, place) % std::size(kOrder)];
}

}  // namespace warmjoint::figures
