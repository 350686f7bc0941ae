// Reading numbers without surprises.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace warmjoint {

/// The number that `text` holds, blanks around it allowed; nothing when any other character is
/// left over or the number overflows; what is smaller than the smallest is 0 or next to it. "nan" and "inf" are read as such: the caller says if they
/// fit.
std::optional<double> ParseNumber(std::string_view text);

/// The same without "nan" and "inf".
std::optional<double> ParseFinite(std::string_view text);

/// The same for whole numbers; nothing for "1.5", "1e3" or what does not fit 64 bits.
std::optional<std::int64_t> ParseInteger(std::string_view text);

/// The same for whole numbers from 0 to 2^64 - 1, as seeds are; nothing for "-1".
std::optional<std::uint64_t> ParseUnsigned(std::string_view text);

}  // namespace warmjoint
