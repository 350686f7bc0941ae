// From the columns of a file to checked measurements.
#pragma once

#include <string>
#include <vector>

#include "models/recording/recording_columns.h"

namespace warmjoint::inline models {

/// The numbers of a file as they stand there.
struct RawColumns {
  std::string file;
  std::vector<int> line;                // [N] line of each sample; empty for files without lines
  std::vector<Eigen::VectorXd> values;  // [N] each, in the order of the sources

  /// Where sample i stands.
  Place At(Eigen::Index i) const {
    return {file, line.empty() ? 0 : line[static_cast<std::size_t>(i)]};
  }
};

/// Converts to SI, scales, checks, and unwraps a position that stays within one turn or wraps as the
/// layout says; notes say so. A
/// velocity that the file lacks stays empty. Throws BadInput for fewer than three samples, a value
/// that is not finite, time that does not increase and a torque that never changes.
Measurements AssembleMeasurements(RawColumns raw, const std::vector<ColumnSource>& sources,
                                  const CsvLayout& layout);

/// Throws BadInput for what no log may hold: fewer than three samples, a value that is not finite, time
/// that does not increase from sample to sample, a torque that never changes.
void CheckSamples(const Measurements& measurements);

}  // namespace warmjoint::inline models
