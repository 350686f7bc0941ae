#include "identification/read_options.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "models/foundation/excerpt.h"
#include "models/foundation/nearest_name.h"
#include "models/foundation/parse_number.h"

namespace warmjoint::inline identification {
namespace {

std::vector<std::string> Split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

bool IsInt(std::string_view text) {
  const auto number = ParseInteger(text);
  return number && std::abs(*number) <= std::numeric_limits<int>::max();
}

bool Satisfies(double value, const std::string& relation, double bound) {
  if (relation == ">") return value > bound;
  if (relation == ">=") return value >= bound;
  if (relation == "<") return value < bound;
  return value <= bound;
}

/// Whether `value` is a number of `kind` within `bounds`: relation, bound, relation, bound, ...
bool IsNumberWithin(const std::string& value, const std::string& kind, std::istream& bounds) {
  const auto number = ParseFinite(value);
  // finite, whole where it must be, and within every bound
  if (!number || (kind == "integer" && !IsInt(value))) return false;
  std::string relation;
  for (double bound; bounds >> relation >> bound;) {
    if (!Satisfies(*number, relation, bound)) return false;
  }
  return true;
}

bool IsAllowed(const OptionInfo& option, const std::string& value) {
  // a kind of value with its bounds, or words to choose from
  std::istringstream stream(option.allowed);
  std::string kind;
  stream >> kind;
  if (kind == "number" || kind == "integer") return IsNumberWithin(value, kind, stream);
  if (kind == "text") return true;
  if (kind == "range") return ParseRange(value).has_value();
  const std::vector<std::string> words = Split(option.allowed, '|');
  return std::find(words.begin(), words.end(), value) != words.end();
}

void CheckValue(const OptionInfo& option, const std::string& value, const Place& place) {
  if (IsAllowed(option, value)) return;
  // what would be allowed, in the words that suit the kind
  if (option.allowed == "range") {
    Refuse(place, "option {} is '{}'; give two numbers lower:upper, for example {} ({})",
           option.name, Excerpt(value), option.default_value, option.meaning);
  }
  if (option.allowed.find('|') != std::string::npos) {
    Refuse(place, "option {} is '{}'{}", option.name, Excerpt(value),
           Suggestion(value, Split(option.allowed, '|')));
  }
  Refuse(place, "option {} is '{}'; it must be: {} ({}; default {})", option.name, Excerpt(value),
         option.allowed, option.meaning, option.default_value);
}

}  // namespace

Options ReadOptions(const std::vector<OptionInfo>& table,
                    const std::map<std::string, std::string>& given, const Place& place) {
  // defaults first
  Options::Values values;
  std::map<std::string, std::string> changed;
  std::vector<std::string> names;
  for (const OptionInfo& option : table) {
    names.push_back(option.name);
    values[option.name] = option.default_value;
  }

  // then what was given, each against its row of the table
  for (const auto& [name, value] : given) {
    const auto row = std::find(names.begin(), names.end(), name);
    if (row == names.end()) {
      const std::string known = names.empty() ? "; there are none here" : Suggestion(name, names);
      Refuse(place, "there is no option '{}'{}", Excerpt(name), known);
    }
    const OptionInfo& option = table[static_cast<size_t>(row - names.begin())];
    CheckValue(option, value, place);
    values[name] = value;
    if (value != option.default_value) changed[name] = value;
  }
  return {std::move(values), std::move(changed)};
}

}  // namespace warmjoint::inline identification
