// Numbers as JSON.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>

namespace warmjoint {

/// The number; null where it is not finite.
inline nlohmann::json NumberOrNull(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

}  // namespace warmjoint
