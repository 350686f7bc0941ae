// Recordings as MATLAB files, v4 to v7.3.
#pragma once

#include <string>

#include "models/recording/csv.h"
#include "models/recording/measurements.h"

namespace warmjoint::inline models {

/// Reads vectors of real numbers as ReadCsv reads columns. Those of a struct are named with a dot,
/// log.time; names without one may leave out the struct where the file holds one alone. A variable
/// `joint` ("rotary" or "linear"), a number `gear`, and texts in a struct `unit` by the columns' names count where
/// the layout has its defaults. Objects, as timeseries, cannot be read: save their Time and Data.
/// The library (matio) works in a child process with limits on memory and time, as ReadHdf5Apart.
/// Throws BadInput as ReadCsv does. For a process with one thread, as programs are at first.
/// patience: s of computing for a small file; large ones get more.
Measurements ReadMatlabApart(const std::string& path, const CsvLayout& layout = {},
                             double patience = 30);

}  // namespace warmjoint::inline models
