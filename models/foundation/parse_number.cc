#include "models/foundation/parse_number.h"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>

#include "models/foundation/excerpt.h"

namespace warmjoint {
namespace {

/// What from_chars reads of a text.
std::string_view Readable(std::string_view text) {
  text = Trimmed(text);
  // from_chars knows no plus sign
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  return text;
}

template <typename T>
std::optional<T> Parse(std::string_view text) {
  const std::string_view trimmed = Readable(text);
  const char* end = trimmed.data() + trimmed.size();
  T value{};
  const auto [rest, error] = std::from_chars(trimmed.data(), end, value);
  // all of the text must be the number
  if (error != std::errc() || rest != end) return std::nullopt;
  return value;
}

}  // namespace

std::optional<double> ParseNumber(std::string_view text) {
  if (const auto number = Parse<double>(text)) return number;

  // from_chars tells overflow from underflow by nothing, strtod by its value
  const std::string_view trimmed = Readable(text);
  double ignored = 0;
  const char* end = trimmed.data() + trimmed.size();
  const auto [rest, error] = std::from_chars(trimmed.data(), end, ignored);
  if (error != std::errc::result_out_of_range || rest != end) return std::nullopt;
  // too small for a double counts as what strtod makes of it, too large is refused
  const double value = std::strtod(std::string(trimmed).c_str(), nullptr);
  if (std::abs(value) > 1) return std::nullopt;
  return value;
}

std::optional<double> ParseFinite(std::string_view text) {
  const auto number = ParseNumber(text);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

std::optional<std::uint64_t> ParseUnsigned(std::string_view text) {
  return Parse<std::uint64_t>(text);
}

std::optional<std::int64_t> ParseInteger(std::string_view text) {
  return Parse<std::int64_t>(text);
}

}  // namespace warmjoint
