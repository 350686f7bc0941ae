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

#include <warmjoint/recording.h>

#include <string>

namespace warmjoint {

/// Its name.
inline constexpr const char* kProjectFile = "warmjoint.yaml";

/// Reads the text of a project file. Throws BadInput with `file` and line for what is no YAML, a key or
/// column that there is not (with the nearest), a value out of its bounds, and for a command or an
/// identifier: a file that lies beside a log from elsewhere must not choose what runs.
Project ParseProject(const std::string& text, const std::string& file);

}  // namespace warmjoint
