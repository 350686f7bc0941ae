// Recordings in the format that their name tells.
#pragma once

#include <string>

#include "models/recording/csv.h"
#include "models/recording/measurements.h"

namespace warmjoint::inline models {

/// Reads .h5 and .hdf5 as HDF5, anything else as CSV. Throws BadInput as ReadCsv does.
Measurements ReadRecording(const std::string& path, const CsvLayout& layout = {});

/// The same for files from anywhere, and .mat as MATLAB files: HDF5 and MATLAB files are read in a child
/// process (read_apart.h).
Measurements ReadForeignRecording(const std::string& path, const CsvLayout& layout = {});

/// Writes .h5 and .hdf5 as HDF5, .csv as CSV. Throws BadInput for other names.
void WriteRecording(const Measurements& measurements, const std::string& path);

}  // namespace warmjoint::inline models
