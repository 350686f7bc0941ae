#include "identification/options.h"

#include <fmt/format.h>

#include <stdexcept>
#include <string>

#include "models/foundation/parse_number.h"

namespace warmjoint::inline identification {

std::optional<std::pair<double, double>> ParseRange(std::string_view text) {
  // both ends must be numbers, the lower one first
  const size_t colon = text.find(':');
  if (colon == std::string_view::npos) return std::nullopt;
  const auto lower = ParseFinite(text.substr(0, colon));
  const auto upper = ParseFinite(text.substr(colon + 1));
  if (!lower || !upper || *lower > *upper) return std::nullopt;
  return std::pair(*lower, *upper);
}

const std::string& Options::Text(std::string_view name) const {
  const auto found = values_.find(name);
  // a bug of the identifier, in every build: there is no text to go on with
  if (found == values_.end()) {
    throw std::logic_error("an identifier asks for the option '" + std::string(name) +
                           "', which its table of options lacks");
  }
  return found->second;
}

double Options::Number(std::string_view name) const {
  const auto number = numbers_.find(name);
  return number != numbers_.end() ? number->second : ParseNumber(Text(name)).value();
}

Options Options::With(std::string_view name, double number) const {
  Options options = *this;
  options.numbers_.insert_or_assign(std::string(name), number);
  // its text is for reports alone
  std::string text = fmt::format("{}", number);
  if (text != Text(name)) options.changed_.insert_or_assign(std::string(name), std::move(text));
  return options;
}

int Options::Integer(std::string_view name) const {
  return static_cast<int>(ParseInteger(Text(name)).value());
}

std::pair<double, double> Options::Range(std::string_view name) const {
  return ParseRange(Text(name)).value();
}

}  // namespace warmjoint::inline identification
