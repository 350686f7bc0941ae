// The log of a whole robot: a wide file with columns for each joint.
#pragma once

#include <warmjoint/recording.h>

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "models/robot_log/robot_columns.h"

namespace warmjoint {

/// N samples of n joints on one clock, even in time.
struct RobotLog {
  std::string source;
  double step = 0;                               // s
  Eigen::VectorXd time;                          // [N] s
  Eigen::MatrixXd position;                      // [N x n] rad or m
  Eigen::MatrixXd torque;                        // [N x n] torque_unit
  Eigen::Array<bool, Eigen::Dynamic, 1> logged;  // [N] false within a gap of the log
  std::string torque_unit;                       // N.m (N for slides) or A, ...
  std::vector<std::string> dead;   // [n] why a joint's torque cannot be used; else empty
  std::vector<std::string> notes;  // what reading made of the file, one phrase each
};

/// The names of a text file's columns; none of a format that does not tell them before it is read.
std::vector<std::string> NamesOfColumns(const std::string& file, const ReadSettings& settings);

/// A joint's own part of a file.
using ReadJoint = std::function<Measurements(const ReadSettings& settings)>;

/// Reads the columns of each joint by the reader of single joints, with its units, stamps, clocks and mends, and joins them on the clock
/// of the first. kinds: [n] of the joints. Throws BadInput as that does; a torque that cannot be used leaves its joint `dead`.
RobotLog ReadRobotLog(const ReadJoint& read, const ReadSettings& settings,
                      const RobotColumns& columns, const std::vector<JointKind>& kinds);

}  // namespace warmjoint
