// The columns of recordings, and their one list: readers, writers and checks run over it.
#pragma once

#include <warmjoint/recording.h>

#include <string>
#include <vector>

#include "models/recording/units.h"

namespace warmjoint {

/// One column that a recording may have.
struct RecordingColumn {
  std::string name;
  bool required = false;
  std::vector<std::string> rotary_units;  // base units that it can have; the first is the default
  std::vector<std::string> linear_units;

  /// The column's values; nullptr where the measurements lack it.
  const Eigen::VectorXd* (*get)(const Measurements& measurements);
  void (*set)(Measurements& measurements, Eigen::VectorXd values);

  const std::vector<std::string>& Units(JointKind joint) const {
    return joint == JointKind::rotary ? rotary_units : linear_units;
  }
};

/// time, position, velocity, torque, motor_position, load, temperature.
const std::vector<RecordingColumn>& RecordingColumns();

/// Their names.
std::vector<std::string> ColumnNames();

/// Base unit of a column in these measurements, for example "rad" or, for torque, "A".
std::string UnitOf(const RecordingColumn& column, const Measurements& measurements);

/// A column of a file.
struct FileColumn {
  std::string name;          // behind its groups, as "robot/elbow/q"
  std::string unit{};        // as the file says beside the name; empty where it does not
  Eigen::VectorXd values{};  // [N]; empty where nobody asks for it
  bool in_words = false;     // the values stand in words as stamps, which were read as s
  std::string refusal{};     // why it holds no numbers, with its place; empty where it does
};

/// Who says in which unit a column is.
enum class UnitFrom {
  option,
  file,    // beside the name
  name,    // as Winkel_deg
  nobody,  // it is the usual one
};

/// A column of a file whose values are wanted.
struct WantedColumn {
  std::size_t index = 0;
  bool is_time = false;  // its cells may be stamps
};

/// A column of ours and where a file has it.
struct ColumnSource {
  const RecordingColumn* column;
  std::size_t index = 0;  // among the columns of the file
  Unit unit{};            // in the file
  UnitFrom unit_from = UnitFrom::nobody;
  std::string
      found_as{};  // its name in the file, where the unit in that told what it is; else empty
  std::vector<std::string>
      of_other_joints{};     // of the position: names of other joints' in the file
  bool is_added = false;     // to the source before it: the nanoseconds of secs+nsecs
  bool in_words = false;     // stamps, which were read as s
  std::string label{};       // what messages call it; empty: by the name of our column
  Eigen::VectorXd values{};  // [N] as they stand in the file, once they are read; NaN: no number
};

/// Finds our columns in a file: the one that `map` names, the one of our name, or of our name and a unit, as "Position [deg]".
/// Groups that all columns lie in may be left out, and '.' and '/' separate alike. Throws BadInput for a missing column (naming
/// what is there and the --map that would help), one that stands there twice, and unknown names
/// and units in the layout, a unit of another quantity, and a torque without a unit that is a current, a voltage, a duty cycle or
/// a load by its name. A column that `map` gives to one of ours is found for no other. A temperature that nothing names is found by its unit. Time, which --rate
/// makes needless, comes first; `time=secs+nsecs` gives two sources, whose sum it is, and so do names as header.stamp.sec and header.stamp.nanosec (FindTime).
/// place: of the header. there: what the file has, for messages; by default the names.
std::vector<ColumnSource> FindColumns(const std::vector<FileColumn>& columns,
                                      const ReadSettings& layout, const Place& place,
                                      const std::string& there = "");

/// The columns that `map` alone names. Throws BadInput as FindColumns does where one is not there.
std::vector<WantedColumn> FindMappedColumns(const std::vector<FileColumn>& columns,
                                            const ReadSettings& layout, const Place& place);

/// Whether the columns are speeds and torques without a clock or a position: a table of points of a friction curve.
bool IsTableOfSpeeds(const std::vector<FileColumn>& columns, const ReadSettings& layout,
                     const Place& place);

}  // namespace warmjoint
