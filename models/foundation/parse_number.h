// Reading numbers without surprises.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace warmjoint::inline models {

/// The number that `text` holds, blanks around it allowed; nothing when any other character is
/// left over or the number overflows. "nan" and "inf" are read as such: the caller says if they
/// fit.
std::optional<double> ParseNumber(std::string_view text);

/// The same for whole numbers; nothing for "1.5", "1e3" or what does not fit 64 bits.
std::optional<std::int64_t> ParseInteger(std::string_view text);

}  // namespace warmjoint::inline models
