// Recordings in the format that their name tells.
#pragma once

#include <warmjoint/recording.h>

#include <string>

#include "models/recording/csv.h"

namespace warmjoint {

/// Reads .h5 and .hdf5 as HDF5, .mat as MATLAB files, anything else as CSV, as ReadCsv does; attributes of a file count
/// where the layout has its defaults. Libraries for HDF5 and MATLAB work in a child process with limits on memory and time
/// (read_apart.h): their crash or hang is BadInput. For a process with one thread, as programs are at first. patience: s of
/// computing for a small file; large ones get more.
Measurements ReadRecordingFile(const std::string& path, const ReadSettings& layout = {},
                               double patience = 30);

}  // namespace warmjoint
