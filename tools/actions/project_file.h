// warmjoint.yaml beside a log: the options that describe the log, written once.
//
//   map: {time: t_s, position: q_deg, torque: force_N}     as --map; a column without a name is left out
//   unit: {position: deg}                                  as --unit
//   scale: {torque: -1}                                    as --scale
//   wrap: 360                                              as --wrap, in the unit of the position
//   joint: rotary                                          rotary or linear
//   gear: 100                                              motor turns for each joint turn
//   trim: 0.2                                              s, as --trim
//   shortest_hold: 1                                       s, as --shortest-hold
#pragma once

#include <optional>
#include <string>

#include "models/recording/read_settings.h"

namespace warmjoint::inline tools {

/// Its name.
inline constexpr const char* kProjectFile = "warmjoint.yaml";

/// What a project file says; what it leaves out is empty.
struct Project {
  ColumnTexts map, unit;
  ColumnNumbers scale;
  std::optional<JointKind> joint;
  std::optional<double> gear, wrap, trim, shortest_hold;

  template <class A>
  void Serialize(A* a) {
    constexpr FieldInfo left_out{.at_default = AtDefault::left_out};
    a->Field("map", &map, left_out);
    a->Field("unit", &unit, left_out);
    a->Field("scale", &scale, left_out);
    a->Field("joint", &joint);
    a->Field("gear", &gear);
    a->Check(!gear || *gear != 0, "gear", "a number other than 0");
    a->Field("wrap", &wrap, {.bounds = {.above = 0}});
    a->Field("trim", &trim, {.unit = "s", .bounds = {.at_least = 0}});
    a->Field("shortest_hold", &shortest_hold, {.unit = "s", .bounds = {.at_least = 0}});
  }
};

/// Reads the text of a project file. Throws BadInput with `file` and line for what is no YAML, a key or
/// column that there is not (with the nearest), a value out of its bounds, and for a command or an
/// identifier: a file that lies beside a log from elsewhere must not choose what runs.
Project ParseProject(const std::string& text, const std::string& file);

}  // namespace warmjoint::inline tools
