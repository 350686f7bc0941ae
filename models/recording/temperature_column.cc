#include "models/recording/temperature_column.h"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "models/recording/units.h"

namespace warmjoint::inline models {

std::optional<std::string> TemperatureUnitIn(const std::string& name) {
  // brackets and blanks behind a unit are no part of it
  constexpr std::string_view separators = "_ [(/.-";
  std::string_view text = name;
  while (!text.empty() && std::string_view("]) ").find(text.back()) != std::string_view::npos) {
    text.remove_suffix(1);
  }

  // the unit must stand by itself, behind a separator
  for (const Unit& unit : Units()) {
    if (unit.base != "degC" || !text.ends_with(unit.name)) continue;
    const std::string_view before = text.substr(0, text.size() - unit.name.size());
    if (before.empty() || separators.find(before.back()) == std::string_view::npos) continue;
    // K may be anything: the rest must speak of a temperature
    std::string lower(before);
    std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return std::tolower(c); });
    const bool speaks = lower.find("temp") != std::string::npos || lower.substr(0, 2) == "t_" ||
                        lower.substr(0, 2) == "t ";
    if (unit.name != "K" || speaks) return std::string(unit.name);
  }
  return std::nullopt;
}

std::optional<std::size_t> FindTemperature(const std::vector<std::string>& names) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!TemperatureUnitIn(names[i])) continue;
    // of two candidates neither is taken
    if (found) return std::nullopt;
    found = i;
  }
  return found;
}

}  // namespace warmjoint::inline models
