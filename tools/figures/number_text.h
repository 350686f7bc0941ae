// Numbers and units as set in print.
#pragma once

#include <string>
#include <string_view>

namespace warmjoint::figures {

/// A number as a person writes it: true minus sign, and 5·10⁻⁵ below 0.001 or from 100 000 on.
/// decimals: digits after the point where no power of ten is used.
std::string NumberText(double value, int decimals);

/// The same with `digits` significant digits.
std::string SignificantText(double value, int digits = 3);

/// A unit as set in print: "N·m·s²/rad" for "N.m.s^2/rad".
std::string UnitText(std::string_view unit);

}  // namespace warmjoint::figures
