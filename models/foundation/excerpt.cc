#include "models/foundation/excerpt.h"

#include <fmt/format.h>

#include <algorithm>

namespace warmjoint {
namespace {

/// Whether terminals act on the character instead of showing it.
bool IsActive(char32_t code) {
  const auto within = [code](char32_t low, char32_t high) { return low <= code && code <= high; };
  return code < 0x20 || within(0x7F, 0x9F) || code == 0x061C || within(0x200E, 0x200F) ||
         within(0x2028, 0x202E) || within(0x2066, 0x2069) || code == 0xFEFF;
}

constexpr std::size_t kMostListed = 24;

}  // namespace

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

std::string Excerpt(std::string_view text, std::size_t longest) {
  // the end of the first characters; a byte that is no UTF-8 counts as one
  std::size_t end = 0;
  for (std::size_t characters = 0; end < text.size() && characters < longest; ++characters) {
    end += std::max<std::size_t>(1, FirstCharacter(text.substr(end)).length);
  }
  const std::string excerpt = Printable(text.substr(0, end));
  return end < text.size() ? excerpt + "..." : excerpt;
}

std::string ExcerptOfList(const std::vector<std::string>& texts) {
  std::vector<std::string> shown;
  for (const std::string& text : texts) {
    if (shown.size() == kMostListed) break;
    shown.push_back(Excerpt(text));
  }
  // how many are not shown
  const std::size_t more = texts.size() - shown.size();
  const std::string list = fmt::format("{}", fmt::join(shown, ", "));
  return more == 0 ? list : fmt::format("{} and {} more", list, more);
}

}  // namespace warmjoint
