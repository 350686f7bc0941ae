// The log of a whole robot: a wide table with columns for each joint.
#pragma once

#include <warmjoint/recording.h>

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "models/recording/assemble.h"
#include "models/robot_log/robot_columns.h"

namespace warmjoint {

/// N samples of n joints on one clock, even in time.
struct RobotLog {
  std::string source;
  double step = 0;           // s
  Eigen::VectorXd time;      // [N] s
  Eigen::MatrixXd position;  // [N x n] rad or m
  Eigen::MatrixXd torque;    // [N x n] torque_unit
  /// [N x n] false within a gap of any joint's positions or of the joint's torque
  Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> logged;
  std::string torque_unit;         // N.m (N for slides) or A, ...
  std::vector<std::string> dead;   // [n] why a joint's torque cannot be used; else empty
  std::vector<std::string> notes;  // what reading made of the file, one phrase each
};

/// A log as it is given: a file, or columns or a table of text in memory.
struct RobotLogSource {
  std::string name;                      // of the file, or what messages call it
  std::optional<FileContent> columns{};  // in place of the file
  std::optional<std::string> text{};     // the same
};

/// The columns of the joints, by the columns of a log. place: of the header
using FindLogColumns = std::function<RobotColumns(const FileContent& content, const Place& place)>;

/// The columns of a log, with the values of those that `find` gives to joints; a file is opened once. settings: names of columns in place
/// of a header. Throws BadInput, also as `find` does.
FileContent ReadRobotTable(const RobotLogSource& source, const ReadSettings& settings,
                           const FindLogColumns& find);

/// The joints of a table on one clock: the table has one, which is mended once; each position and each torque is then a column of its own,
/// with its own rows without a number, its unit and its gaps. kinds: [n] of the joints. Throws BadInput where the clock or a position
/// cannot be used; a torque that cannot be used leaves its joint `dead`.
RobotLog ReadRobotLog(const std::string& source, FileContent table, const ReadSettings& settings,
                      const RobotColumns& columns, const std::vector<JointKind>& kinds);

}  // namespace warmjoint
