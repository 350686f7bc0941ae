// Fields: what a model of the torque may lack, as random functions whose strength the log decides.
#pragma once

#include <warmjoint/field.h>

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace warmjoint {

/// What a field depends on, and whether it acts against the motion. In the order in which a search takes them.
enum class FieldKind {
  place_torque,          // q(position): a load
  place_friction,        // r(position) sign(v)
  speed_friction,        // c(|v|) sign(v)
  temperature_friction,  // k(measured temperature) sign(v)
  time_friction,         // d(time) sign(v)
  time_torque            // t(time)
};

inline std::span<const Word<FieldKind>> WordsOf(FieldKind) {
  using enum FieldKind;
  static constexpr std::array words{Word{"q", place_torque},   Word{"r", place_friction},
                                    Word{"v", speed_friction}, Word{"k", temperature_friction},
                                    Word{"d", time_friction},  Word{"t", time_torque}};
  return words;
}

/// Whether a field turns with the direction of motion, as friction does.
inline bool IsFriction(FieldKind kind) {
  return kind != FieldKind::place_torque && kind != FieldKind::time_torque;
}

/// Which fields a fit has: "auto", "none", or letters of q,r,v,k,d,t with commas between them.
struct FieldSet {
  static constexpr const char* kAllowed = "auto|none|q,r,v,k,d,t";
  std::vector<FieldKind> kinds;

  static FieldSet All();
  bool Has(FieldKind kind) const { return std::ranges::find(kinds, kind) != kinds.end(); }
  bool operator==(const FieldSet&) const = default;
};
inline constexpr FieldInfo kFieldsInfo{
    .meaning =
        "what the model may lack, with a strength that the log decides: auto, none, or letters of "
        "q (torque over the "
        "place), r (friction over the place), v (curve over the speed), k (friction over a logged "
        "temperature), d (drift of the friction), "
        "t (drift of the torque)"};

}  // namespace warmjoint
