// Recordings as MATLAB files, v4 to v7.3.
#pragma once

#include <string>

#include "models/recording/assemble.h"

namespace warmjoint {

/// Vectors of real numbers, as far as the layout asks for them. Those of a struct are named with a dot,
/// log.time; names without one may leave out the struct where the file holds one alone. A variable
/// `joint` ("rotary" or "linear"), a number `gear`, and texts in a struct `unit` by the columns' names count where
/// the layout has its defaults. Objects, as timeseries, cannot be read: save their Time and Data. Throws BadInput, also
/// where the layout's columns are not there. One thread at a time. The library (matio)
/// crashes on some damaged files: ReadRecordings calls this in a child process.
FileContent ReadMatlabContent(const std::string& path, const ReadSettings& layout);

}  // namespace warmjoint
