// From the columns of a file to checked measurements.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "models/recording/recording_columns.h"

namespace warmjoint {

/// The numbers of a file as they stand there.
struct RawColumns {
  std::string file;
  std::vector<int> line;                // [N] line of each sample; empty for files without lines
  std::vector<Eigen::VectorXd> values;  // [N] each, in the order of the sources; NaN: no number
  bool stamps = false;                  // time stands in words, which were read as s
  std::vector<std::string> notes;       // what reading made of the file

  /// Where sample i stands.
  Place At(Eigen::Index i) const {
    return {file, line.empty() ? 0 : line[static_cast<std::size_t>(i)]};
  }
};

/// Converts to SI, scales, checks, mends a clock of coarse ticks, and unwraps a position that stays within one turn or wraps as
/// the layout says. Samples that lack a number are left out, and optional columns that lack most of theirs; notes say so. A
/// velocity that the file lacks stays empty. Throws BadInput for fewer than three samples, a value that is not finite, time that
/// does not increase or is clearly in another unit, and a torque that never changes.
Measurements AssembleMeasurements(RawColumns raw, std::vector<ColumnSource> sources,
                                  const ReadSettings& layout);

/// A one-dimensional array of numbers with a name.
struct FileColumn {
  std::string name;
  std::string unit;        // as the file says; empty where it does not
  Eigen::VectorXd values;  // [N]; empty where the layout does not ask for it
};

struct FileContent {
  std::string joint;           // "rotary" or "linear"; empty where the file does not say
  std::optional<double> gear;  // the same
  std::vector<FileColumn> columns;
};

/// The layout, completed by what the file says of itself.
ReadSettings WithAttributes(ReadSettings layout, const FileContent& content,
                            const Place& place = {});

/// The names of the columns, as FindColumns takes them.
std::vector<std::string> NamesOf(const FileContent& content);

/// The recording. Throws BadInput as ReadCsv does, and for columns of different lengths.
Measurements AssembleContent(const FileContent& content, const std::string& path,
                             const ReadSettings& layout);

}  // namespace warmjoint
