#include "models/foundation/utf8.h"

namespace warmjoint::inline models {

Character FirstCharacter(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  if (first < 0x80) return {first, 1};
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < length) return {};
  char32_t code = first & (0x7Fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3F);
  }
  // longer than need be, halves of pairs, beyond the last
  constexpr char32_t least[]{0, 0, 0x80, 0x800, 0x10000};
  const bool valid = code >= least[length] && (code < 0xD800 || code > 0xDFFF) && code <= 0x10FFFF;
  return valid ? Character{code, length} : Character{};
}

std::optional<std::size_t> FirstBrokenByte(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const Character character = FirstCharacter(text.substr(at));
    if (character.length == 0 || character.code == 0) return at;
    at += character.length;
  }
  return std::nullopt;
}

}  // namespace warmjoint::inline models
