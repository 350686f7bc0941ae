// Recordings as CSV: header row, then one row a sample.
#pragma once

#include <warmjoint/recording.h>

#include <string>
#include <string_view>

namespace warmjoint {

/// Reads columns time, position, velocity, torque and optional motor_position, load, temperature.
/// A missing velocity stays empty. Throws BadInput with file:line for: an empty
/// file, a missing column, text in a number, NaN, time that does not increase, fewer than three
/// samples, a constant torque, an unknown name in `layout`.
Measurements ReadCsv(const std::string& path, const ReadSettings& layout = {});

/// The same for text in memory; `name` stands for the file in messages.
Measurements ParseCsv(std::string_view text, const std::string& name,
                      const ReadSettings& layout = {});

/// The text of a file with the columns that are present, SI, numbers that read back bit for bit.
std::string RecordingToCsv(const Measurements& measurements);

}  // namespace warmjoint
