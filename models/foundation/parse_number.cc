#include "models/foundation/parse_number.h"

#include <charconv>

namespace warmjoint::inline models {
namespace {

std::string_view Trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  const size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  text = text.substr(first, text.find_last_not_of(blanks) - first + 1);

  // from_chars knows no plus sign
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  return text;
}

template <typename T>
std::optional<T> Parse(std::string_view text) {
  const std::string_view trimmed = Trimmed(text);
  const char* end = trimmed.data() + trimmed.size();
  T value{};
  const auto [rest, error] = std::from_chars(trimmed.data(), end, value);
  if (error != std::errc() || rest != end) return std::nullopt;
  return value;
}

}  // namespace

std::optional<double> ParseNumber(std::string_view text) { return Parse<double>(text); }

std::optional<std::int64_t> ParseInteger(std::string_view text) {
  return Parse<std::int64_t>(text);
}

}  // namespace warmjoint::inline models
