// Units that logs use, and how they become SI.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "models/foundation/bad_input.h"

namespace warmjoint {

/// value in `base` = factor * (value in this unit) + offset.
struct Unit {
  std::string_view name;
  std::string_view base;  // SI unit, or what is carried through as it is: A, V, %, raw
  double factor = 1;
  double offset = 0;
};

/// All units that `--unit` knows.
const std::vector<Unit>& Units();

/// The unit of that name, whose base must be one of `bases`. Throws BadInput that names the column
/// and the units that it can have.
const Unit& FindUnit(std::string_view name, const std::vector<std::string>& bases,
                     std::string_view column, const Place& place);

}  // namespace warmjoint
