// How the columns of a foreign file become ours.
#pragma once

#include <warmjoint/friction.h>

#include <map>
#include <string>

#include "models/foundation/node.h"

namespace warmjoint::inline models {

/// What is said of single columns of ours, by their names. A map in YAML, where a column without a text has an empty one;
/// in JSON a list of "column=text".
struct ColumnTexts : std::map<std::string, std::string> {
  using map::map;
};
void ReadValue(const Node& node, ColumnTexts* value, const FieldInfo& info);
Tree WriteValue(const ColumnTexts& value);

/// The same of numbers.
struct ColumnNumbers : std::map<std::string, double> {
  using map::map;
};
void ReadValue(const Node& node, ColumnNumbers* value, const FieldInfo& info);
Tree WriteValue(const ColumnNumbers& value);

struct ReadSettings {
  ColumnTexts
      map;  // ours -> theirs, as torque -> force_N (--map); an empty name leaves a column out
  ColumnTexts unit;     // ours -> unit in the file, as position -> deg (--unit)
  ColumnNumbers scale;  // ours -> factor on the values of the file, as torque -> -1 (--scale)
  /// Range after which a position sensor starts again, in the unit of the file (--wrap); 0: a turn.
  double wrap = 0;
  JointKind joint = JointKind::rotary;
  double gear = 1;  // motor turns for each joint turn (rotary), rad of motor per m (linear)
  double torque_constant = 0;  // N.m/A or N/A at the joint: makes torque of a current; 0: none

  template <class A>
  void Serialize(A* a) {
    constexpr FieldInfo left_out{.at_default = AtDefault::left_out};
    a->Field("map", &map);
    a->Field("unit", &unit);
    a->Field("joint", &joint);
    a->Field("gear", &gear);
    a->Field("scale", &scale, left_out);
    a->Field("wrap", &wrap, left_out);
    a->Field("torque_constant", &torque_constant, left_out);
  }
};

/// Throws BadInput for a number that cannot be meant: a gear of 0, a range below 0, what is not finite.
void CheckReadSettings(const ReadSettings& settings);

}  // namespace warmjoint::inline models
