#include "models/foundation/parse_number.h"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>

#include "models/foundation/excerpt.h"

namespace warmjoint {
namespace {

/// Reads a number that is all of a text, and tells why it cannot.
template <typename T>
std::errc FromChars(std::string_view text, T& value) {
  text = Trimmed(text);
  // from_chars knows no plus sign
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  return rest == end ? error : std::errc::invalid_argument;
}

template <typename T>
std::optional<T> Parse(std::string_view text) {
  T value{};
  return FromChars(text, value) == std::errc() ? std::optional(value) : std::nullopt;
}

}  // namespace

std::optional<double> ParseNumber(std::string_view text) {
  double number = 0;
  const std::errc error = FromChars(text, number);
  if (error == std::errc()) return number;
  if (error != std::errc::result_out_of_range) return std::nullopt;

  // from_chars tells overflow from underflow by nothing, strtod by its value: what is too small for a double counts as
  // what strtod makes of it, what is too large is refused
  const double value = std::strtod(std::string(text).c_str(), nullptr);
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
