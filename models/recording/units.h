// Units that logs use, and how they become SI; times in words and as counts.
#pragma once

#include <optional>
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

/// The unit that a text means, in brackets or not and in any of its spellings, as "[°/s]", "1/min", "N*m" or "DEG".
/// Nothing where it is none of those with one of `bases`; without bases any unit counts.
std::optional<Unit> MeantUnit(std::string_view text, const std::vector<std::string>& bases = {});

/// The unit of that name, whose base must be one of `bases`. Throws BadInput that names the column
/// and the units that it can have.
Unit FindUnit(std::string_view name, const std::vector<std::string>& bases, std::string_view column,
              const Place& place);

/// A column's name in two, as "Winkel" and deg of "Winkel_deg", "speed" and rad/s of "speed [rad/s]" or "speed_rad_s".
struct NameAndUnit {
  std::string stem;
  std::optional<Unit> unit = {};  // nothing where the name ends in none
  bool is_sure =
      false;  // the unit can be nothing else: it stands in brackets, or is deg, mm or rad/s
};
NameAndUnit SplitUnit(std::string_view name, const std::vector<std::string>& bases = {});

inline constexpr double kDay = 86400;  // s

/// The seconds of a stamp: since 1970 of a date with or without a time, as 2024-03-01T12:00:00.123+01:00 or "01.03.2024 12:00:00";
/// since midnight of a time, as 12:00:00.123, 12:00:00:123, "1:00:00 PM" or 59:59.9; of a duration, as "0.02 sec", "20 ms" or
/// "0 days 00:00:01.5". Nothing for other texts, plain numbers, and dates of which no one knows the month, as 03/04/2024, or the year, as 24-03-04.
std::optional<double> ReadStamp(std::string_view text);

}  // namespace warmjoint
