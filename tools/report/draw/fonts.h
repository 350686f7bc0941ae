// The typefaces of the pictures.
#pragma once

#include <span>

namespace warmjoint::report {

/// TrueType files inside the program: DejaVu Sans, which has Greek letters, arrows, superscripts.
std::span<const unsigned char> RegularFont();
std::span<const unsigned char> BoldFont();

}  // namespace warmjoint::report
