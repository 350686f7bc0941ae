#include "models/foundation/printable.h"

#include <fmt/format.h>

#include <algorithm>

#include "models/foundation/utf8.h"

namespace warmjoint::inline models {
namespace {

/// Whether terminals act on the character instead of showing it.
bool IsActive(char32_t code) {
  const auto within = [code](char32_t low, char32_t high) { return low <= code && code <= high; };
  return code < 0x20 || within(0x7F, 0x9F) || code == 0x061C || within(0x200E, 0x200F) ||
         within(0x2028, 0x202E) || within(0x2066, 0x2069) || code == 0xFEFF;
}

}  // namespace

std::string Printable(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    const Character character = FirstCharacter(text);
    const std::size_t length = std::max<std::size_t>(1, character.length);
    // bytes that are no character, and characters that act, are shown by their codes
    if (character.length == 0) {
      shown += fmt::format("\\x{:02X}", static_cast<unsigned char>(text[0]));
    } else if (IsActive(character.code)) {
      const auto code = static_cast<unsigned>(character.code);
      shown += code < 0x80 ? fmt::format("\\x{:02X}", code) : fmt::format("\\u{:04X}", code);
    } else {
      shown += text.substr(0, length);
    }
    text.remove_prefix(length);
  }
  return shown;
}

std::string PrintableLines(std::string_view text) {
  std::string shown;
  for (std::size_t end; (end = text.find('\n')) != std::string_view::npos;) {
    shown += Printable(text.substr(0, end)) + "\n";
    text.remove_prefix(end + 1);
  }
  return shown + Printable(text);
}

}  // namespace warmjoint::inline models
