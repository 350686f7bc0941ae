// Rows of one identifier share its colour; strokes and markers tell them apart.
#pragma once

#include <cstddef>
#include <iterator>

#include "tools/report/draw/figure.h"

namespace warmjoint::report {

/// How many rows before rows[place] are of the same identifier.
template <typename Rows>
std::size_t EarlierOfSame(const Rows& rows, std::size_t place) {
  std::size_t earlier = 0;
  for (std::size_t i = 0; i < place; ++i) earlier += rows[i].identifier == rows[place].identifier;
  return earlier;
}

/// The stroke of an identifier's first, second, ... row.
template <typename Rows>
Dash DashOf(const Rows& rows, std::size_t place) {
  static constexpr Dash kOrder[] = {Dash::solid, Dash::dashed, Dash::dotted};
  return kOrder[EarlierOfSame(rows, place) % std::size(kOrder)];
}

/// The marker of an identifier's first, second, ... row.
template <typename Rows>
Marker MarkerOf(const Rows& rows, std::size_t place) {
  static constexpr Marker kOrder[] = {Marker::circle, Marker::square, Marker::diamond, Marker::up};
  return kOrder[EarlierOfSame(rows, place) % std::size(kOrder)];
}

}  // namespace warmjoint::report
