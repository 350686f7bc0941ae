// Rotary and linear joints: which units go with which.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "models/foundation/field.h"

namespace warmjoint::inline models {

enum class JointKind { rotary, linear };

inline std::span<const Word<JointKind>> WordsOf(JointKind) {
  static constexpr std::array words{Word{"rotary", JointKind::rotary},
                                    Word{"linear", JointKind::linear}};
  return words;
}

/// A unit for each kind of joint, for example {"N.m", "N"}.
struct JointUnit {
  std::string_view rotary;
  std::string_view linear;
  int way = 0;   // power of rad or m beside torque or force
  int time = 0;  // power of s

  constexpr std::string_view For(JointKind kind) const {
    return kind == JointKind::rotary ? rotary : linear;
  }
};

inline constexpr JointUnit kPositionUnit{"rad", "m", 1, 0};
inline constexpr JointUnit kVelocityUnit{"rad/s", "m/s", 1, -1};
inline constexpr JointUnit kTorqueUnit{"N.m", "N"};
inline constexpr JointUnit kViscousUnit{"N.m.s/rad", "N.s/m", -1, 1};
inline constexpr JointUnit kStiffnessUnit{"N.m/rad", "N/m", -1, 0};
inline constexpr JointUnit kLevelPerTemperatureUnit{"N.m/K", "N/K"};
inline constexpr JointUnit kTimePerPositionUnit{"s/rad", "s/m", -1, 1};
inline constexpr JointUnit kThermalGainUnit{"N.m/W", "N/W", -1, 1};

}  // namespace warmjoint::inline models
