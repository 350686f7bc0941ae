// What of a torque a random field holds.
#pragma once

#include <array>
#include <span>

#include "models/foundation/serialize.h"

namespace warmjoint {

/// What a field depends on, and whether it acts against the motion. In the order in which a search takes them.
enum class FieldKind {
  place_torque,    // q(position): a load
  place_friction,  // r(position) sign(v)
  speed_friction,  // c(|v|) sign(v)
  time_friction,   // d(time) sign(v)
  time_torque      // t(time)
};

inline std::span<const Word<FieldKind>> WordsOf(FieldKind) {
  using enum FieldKind;
  static constexpr std::array words{Word{"q", place_torque}, Word{"r", place_friction},
                                    Word{"v", speed_friction}, Word{"d", time_friction},
                                    Word{"t", time_torque}};
  return words;
}

/// Whether a field turns with the direction of motion, as friction does.
inline bool IsFriction(FieldKind kind) {
  return kind != FieldKind::place_torque && kind != FieldKind::time_torque;
}

}  // namespace warmjoint
