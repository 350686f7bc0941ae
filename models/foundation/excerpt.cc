#include "models/foundation/excerpt.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

namespace warmjoint {
namespace {

/// Whether terminals act on the character instead of showing it, or XML 1.0 has no place for it.
bool IsActive(char32_t code) {
  const auto within = [code](char32_t low, char32_t high) { return low <= code && code <= high; };
  return code < 0x20 || within(0x7F, 0x9F) || code == 0x061C || within(0x200E, 0x200F) ||
         within(0x2028, 0x202E) || within(0x2066, 0x2069) || code == 0xFEFF || code == 0xFFFE ||
         code == 0xFFFF;
}

constexpr std::size_t kMostListed = 24;
constexpr std::size_t kShortList = 60;  // characters that stand beside a suggestion
constexpr std::size_t kLongList = 120;  // and without one
constexpr std::size_t kHalf = 3;        // letters that make a beginning

/// Whether one of two words begins or ends with all of the other.
bool IsHalfOf(std::string_view a, std::string_view b) {
  if (a.size() > b.size()) std::swap(a, b);
  return a.size() >= kHalf && (b.starts_with(a) || b.ends_with(a));
}

/// As many of the names as fit, and how many more there are.
std::string ShortList(const std::vector<std::string>& known) {
  // the first name always, further ones as long as the list stays short
  std::string list;
  for (std::size_t i = 0; i < known.size(); ++i) {
    const std::string name = Excerpt(known[i]);
    if (i > 0 && list.size() + name.size() > kLongList) {
      return fmt::format("{} and {} more", list, known.size() - i);
    }
    list += (i > 0 ? ", " : "") + name;
  }
  return list;
}

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

std::string_view Trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string Lowercase(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return std::tolower(c); });
  return lower;
}

bool EqualIgnoringCase(std::string_view a, std::string_view b) {
  return std::ranges::equal(
      a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

int EditDistance(std::string_view a, std::string_view b) {
  // table[i][j]: distance between the first i characters of a and the first j of b
  std::vector<std::vector<int>> table(a.size() + 1, std::vector<int>(b.size() + 1));
  for (size_t i = 0; i <= a.size(); ++i) table[i][0] = static_cast<int>(i);
  for (size_t j = 0; j <= b.size(); ++j) table[0][j] = static_cast<int>(j);

  // the least of deletion, insertion and substitution, or two neighbours swapped
  for (size_t i = 1; i <= a.size(); ++i) {
    for (size_t j = 1; j <= b.size(); ++j) {
      const int substitution = table[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      table[i][j] = std::min({table[i - 1][j] + 1, table[i][j - 1] + 1, substitution});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) table[i][j] = std::min(table[i][j], table[i - 2][j - 2] + 1);
    }
  }
  return table[a.size()][b.size()];
}

std::string Suggestion(std::string_view given, const std::vector<std::string>& known) {
  if (known.empty()) return "";
  // the nearest of those that are known
  const std::string name = Excerpt(given);

  const auto distance = [&](const std::string& one) { return EditDistance(name, one); };
  const std::string& nearest = *std::ranges::min_element(known, {}, distance);

  // suggest only what a slip of the fingers or a word left half explains
  const int allowed = std::max<int>(2, static_cast<int>(name.size()) / 3);
  const auto half =
      std::ranges::find_if(known, [&](const std::string& one) { return IsHalfOf(name, one); });
  const bool is_near = distance(nearest) <= allowed;
  if (!is_near && half == known.end()) return fmt::format("; known: {}", ShortList(known));
  const std::string meant = Excerpt(is_near ? nearest : *half);
  // the whole list beside it, where it is short
  const std::string all = ExcerptOfList(known);
  if (all.size() > kShortList) return fmt::format("; did you mean '{}'?", meant);
  return fmt::format("; did you mean '{}'? Known: {}", meant, all);
}

}  // namespace warmjoint
