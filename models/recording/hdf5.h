// Recordings as HDF5: one dataset a column, units as attributes.
#pragma once

#include <string>

#include "models/recording/csv.h"
#include "models/recording/measurements.h"

namespace warmjoint::inline models {

/// Reads the one-dimensional datasets at the root of an HDF5 file as ReadCsv reads columns. An
/// attribute `unit` of a dataset counts where the layout gives no unit; the attributes `joint`
/// ("rotary" or "linear") and `gear` of the root count where the layout has its defaults. Throws
/// BadInput as ReadCsv does. One thread at a time. For files of one's own: the HDF5 library crashes
/// and hangs on some damaged files before any check of ours acts.
Measurements ReadHdf5(const std::string& path, const CsvLayout& layout = {});

/// The same for files from anywhere: the library works in a child process with limits on memory and
/// time, and its crash or hang is BadInput. For a process with one thread, as programs are at first.
/// patience: s of computing for a small file; large ones get more.
Measurements ReadHdf5Apart(const std::string& path, const CsvLayout& layout = {},
                           double patience = 30);

/// The bytes of a file with the columns that are present, SI, with those attributes. Safe to call from many threads,
/// which wait for each other: the library serves one at a time.
std::string RecordingToHdf5(const Measurements& measurements);

/// Writes these bytes.
void WriteHdf5(const Measurements& measurements, const std::string& path);

}  // namespace warmjoint::inline models
