// Recordings as HDF5: one dataset a column, units as attributes.
#pragma once

#include <string>

#include "models/recording/assemble.h"

namespace warmjoint {

/// The one-dimensional datasets at the root of an HDF5 file, as far as the layout asks for them, with their attribute
/// `unit`, and the root's `joint` ("rotary" or "linear") and `gear`. Throws BadInput, also where the layout's columns are
/// not there or have more than kMostSamples. One thread at a time. The HDF5 library crashes and hangs on some damaged files:
/// ReadRecordings calls this in a child process.
FileContent ReadHdf5Content(const std::string& path, const ReadSettings& layout);

/// The bytes of a file with the columns that are present, SI, with those attributes. Safe to call from many threads,
/// which wait for each other: the library serves one at a time.
std::string RecordingToHdf5(const Measurements& measurements);

}  // namespace warmjoint
