// Recordings as CSV: header row, then one row a sample.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "models/recording/measurements.h"

namespace warmjoint::inline models {

/// How the columns of a foreign file become ours.
struct CsvLayout {
  /// ours -> theirs, for example torque -> force_N (--map); an empty name leaves a column out
  std::map<std::string, std::string> column;
  /// ours -> unit in the file, for example position -> deg (--unit)
  std::map<std::string, std::string> unit;
  /// ours -> factor on the values of the file, for example torque -> -1 (--scale)
  std::map<std::string, std::string> scale;
  /// range after which a position sensor starts again, in the unit of the file (--wrap); 0: a turn
  double wrap = 0;
  JointKind joint = JointKind::rotary;
  double gear = 1;
};

/// Reads columns time, position, velocity, torque and optional motor_position, load, temperature.
/// A missing velocity stays empty. Throws BadInput with file:line for: an empty
/// file, a missing column, text in a number, NaN, time that does not increase, fewer than three
/// samples, a constant torque, an unknown name in `layout`.
Measurements ReadCsv(const std::string& path, const CsvLayout& layout = {});

/// The same for text in memory; `name` stands for the file in messages.
Measurements ParseCsv(std::string_view text, const std::string& name, const CsvLayout& layout = {});

/// The text of a file with the columns that are present, SI, numbers that read back bit for bit.
std::string RecordingToCsv(const Measurements& measurements);

}  // namespace warmjoint::inline models
