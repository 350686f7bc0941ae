// The columns of recordings, and their one list: readers, writers and checks run over it.
#pragma once

#include <warmjoint/recording.h>

#include <string>
#include <vector>

#include "models/recording/csv.h"
#include "models/recording/units.h"

namespace warmjoint {

/// One column that a recording may have.
struct RecordingColumn {
  std::string name;
  bool required = false;
  std::vector<std::string> rotary_units;  // base units that it can have; the first is the default
  std::vector<std::string> linear_units;
  std::vector<std::string> other_names;  // parts of names that foreign files give it, lower case

  /// The column's values; nullptr where the measurements lack it.
  const Eigen::VectorXd* (*get)(const Measurements& measurements);
  void (*set)(Measurements& measurements, Eigen::VectorXd values);

  const std::vector<std::string>& Units(JointKind joint) const {
    return joint == JointKind::rotary ? rotary_units : linear_units;
  }
};

/// time, position, velocity, torque, motor_position, load, temperature.
const std::vector<RecordingColumn>& RecordingColumns();

/// Base unit of a column in these measurements, for example "rad" or, for torque, "A".
std::string UnitOf(const RecordingColumn& column, const Measurements& measurements);

/// A column of ours and where a file has it.
struct ColumnSource {
  const RecordingColumn* column;
  std::size_t index;  // among the names of the file
  Unit unit;          // in the file
  std::string
      found_as{};  // its name in the file, where the unit in that told what it is; else empty
};

/// Finds our columns among the names that a file has. Throws BadInput for a missing column (naming
/// what is there and the --map that would help), one that stands there twice, and unknown names
/// and units in the layout. A temperature that nothing names is found by its unit.
/// place: of the header. there: what the file has, for messages; by default the names.
std::vector<ColumnSource> FindColumns(const std::vector<std::string>& names,
                                      const ReadSettings& layout, const Place& place,
                                      const std::string& there = "");

}  // namespace warmjoint
