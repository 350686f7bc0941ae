// The temperature of a foreign file, known by the unit in its column's name.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace warmjoint::inline models {

/// The unit that a column's name ends in where that is one of temperature: "degC" of motor_degC and of
/// "case [degC]", "K" of temp_K, not of gain_K; nothing of other names.
std::optional<std::string> TemperatureUnitIn(const std::string& name);

/// The one column whose name ends in a unit of temperature; nothing where there is none, or several.
std::optional<std::size_t> FindTemperature(const std::vector<std::string>& names);

}  // namespace warmjoint::inline models
