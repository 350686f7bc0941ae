// Recordings as tables of text.
#pragma once

#include <warmjoint/recording.h>

#include <string>
#include <string_view>

namespace warmjoint {

/// Reads columns time, position, velocity, torque and optional motor_position, load, temperature of a table of text in any of
/// the forms that FindTable knows. A missing velocity stays empty. Throws BadInput with file:line as FindTable, FindColumns
/// and AssembleMeasurements do, for a row that lacks fields and for text in a number.
Measurements ReadCsv(const std::string& path, const ReadSettings& layout = {});

/// The same for text in memory; `name` stands for the file in messages.
Measurements ParseCsv(std::string_view text, const std::string& name,
                      const ReadSettings& layout = {});

/// The text of a file with the columns that are present, SI, numbers that read back bit for bit.
std::string RecordingToCsv(const Measurements& measurements);

}  // namespace warmjoint
