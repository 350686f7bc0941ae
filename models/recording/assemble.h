// From the columns of a file to checked measurements.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "models/recording/clock.h"
#include "models/recording/recording_columns.h"

namespace warmjoint {

/// What was read of a file.
struct RawColumns {
  std::string file;
  std::vector<ColumnSource> columns;  // with their values, all of one length
  std::vector<int> line{};            // [N] of each sample; empty for files without lines
  std::vector<std::string> notes{};   // what reading made of the file
  std::vector<std::string> doubts{};  // what the file itself says of its units

  /// Where sample i stands.
  Place At(Eigen::Index i) const {
    return {file, line.empty() ? 0 : line[static_cast<std::size_t>(i)]};
  }
};

/// Converts to SI, scales, checks, mends a clock of coarse ticks, and unwraps a position that stays within one turn or wraps as
/// the layout says. Samples that lack a number are left out, and optional columns that lack most of theirs; notes say so. A
/// velocity that the file lacks stays empty. Throws BadInput for fewer than three samples, a value that is not finite, time that
/// does not increase or is clearly in another unit, and a torque that never changes.
Measurements AssembleMeasurements(RawColumns raw, const ReadSettings& layout);

/// Makes the first column the time in s, of the layout's rate, of one column, or of the sum of two; all columns lose the rows that
/// have no time or are not on the clock, and notes say so. The unit, where nobody says that: for AssembleOnClock. Throws BadInput
/// where time does not increase.
std::optional<AssumedUnit> TakeClock(const ReadSettings& layout, RawColumns& raw);

/// The last part of AssembleMeasurements: of columns behind their clock, whichever there are besides it. assumed: of TakeClock, where its
/// unit shall be checked against what moves.
Measurements AssembleOnClock(RawColumns raw, const std::optional<AssumedUnit>& assumed,
                             const ReadSettings& layout);

/// Adds the units that the file tells to the notes: those that are not the usual ones, and all of a row of units.
void NoteUnits(const ReadSettings& layout, RawColumns& raw);

/// What a file holds.
struct FileContent {
  std::string joint{};           // "rotary" or "linear"; empty where the file does not say
  std::optional<double> gear{};  // the same
  std::vector<std::string> notes{}, doubts{};  // what was made of it when it was written
  std::vector<FileColumn> columns{};
  std::vector<int> line{};  // [N] of each sample; empty for files without lines
};

/// Which columns are wanted of a file, by its columns without values. header: where those stand; there: what the file has, for
/// messages. Throws BadInput where they are not there.
using WantedColumns = std::function<std::vector<WantedColumn>(
    const FileContent& content, const Place& header, const std::string& there)>;

/// Those that the layout of one joint asks for (FindColumns).
WantedColumns ColumnsOfJoint(const ReadSettings& layout);

/// All columns of a file as sources without values, in the order of `found`; takes their values. Throws BadInput for one that holds no
/// numbers, and for columns of different lengths.
void TakeValues(FileContent& content, const std::string& path, std::vector<ColumnSource>& found);

/// The layout, completed by what the file says of the joint where nobody says otherwise.
ReadSettings WithJointOf(const FileContent& content, ReadSettings layout);

/// The recordings in columns that were read: one, or one for each episode, where the clock begins anew and a column of the
/// file counts episodes. columns: all of the file. Throws BadInput as AssembleMeasurements does.
std::vector<Measurements> AssembleRecordings(RawColumns raw, const std::vector<FileColumn>& columns,
                                             const ReadSettings& layout);

/// The same of a file's content. Throws BadInput as ReadCsv does, and for columns of different lengths.
std::vector<Measurements> AssembleContent(FileContent content, const std::string& path,
                                          const ReadSettings& layout);

/// The recording of a file that may hold one alone. Throws BadInput.
Measurements OnlyOne(std::vector<Measurements> recordings);

/// The layout, with the rate that a table of speeds and torques without a clock gets: each of its rows stands for a hold.
ReadSettings WithClock(const std::vector<FileColumn>& columns, ReadSettings layout,
                       const Place& place);

}  // namespace warmjoint
