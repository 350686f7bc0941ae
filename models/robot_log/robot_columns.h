// Which columns of a wide file belong to which joint of a robot.
#pragma once

#include <warmjoint/recording.h>

#include <string>
#include <vector>

#include "models/foundation/bad_input.h"

namespace warmjoint {

/// The joints that a file holds, and the columns of each.
struct RobotColumns {
  std::vector<std::string> joints;  // [n]
  /// [n] ours -> theirs: time (where the file has one), position and torque.
  std::vector<ColumnTexts> maps;
  bool torque_is_current = false;    // by the name of its columns
  std::vector<std::string> notices;  // how the columns were understood, one sentence each
};

/// The joints and their columns. names: of all columns of the file; none where they are not known before it is read: then `map` must
/// name position and torque. joints: of the robot from the base outwards. map: what is said of time, position and torque
/// (patterns as of ColumnOfJoint). What is not said is found: families of columns that hold the joints' names, these without a word "joint"
/// at an end, or numbers from 0 or 1 on, whose other words speak of a position (q, pos, angle), or of a torque or current; measured ones go before targets, plain names before
/// longer ones. Throws BadInput where nothing or several fit, with the remedy.
RobotColumns FindRobotColumns(const std::vector<std::string>& names,
                              const std::vector<std::string>& joints, const ColumnTexts& map,
                              const Place& place);

}  // namespace warmjoint
