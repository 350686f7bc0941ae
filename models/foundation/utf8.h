// Text of UTF-8, a character at a time.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace warmjoint::inline models {

/// A character: its code and its number of bytes; 0 bytes for what is no UTF-8.
struct Character {
  char32_t code = 0;
  std::size_t length = 0;
};

/// The first character of a text that is not empty.
Character FirstCharacter(std::string_view text);

/// Position of the first byte that is no UTF-8, or of a zero byte.
std::optional<std::size_t> FirstBrokenByte(std::string_view text);

}  // namespace warmjoint::inline models
