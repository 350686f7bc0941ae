// The columns of an HDF5 file.
#pragma once

#include <string>

#include "models/recording/file_content.h"

namespace warmjoint::inline models {

/// Reads the one-dimensional datasets at the root, with their attribute `unit`, and the root's `joint` and
/// `gear`. The HDF5 library crashes and hangs on some damaged files: within this process for files of
/// one's own. Throws BadInput, also where the layout's columns are not there or have more than
/// kMostSamples. One thread at a time.
FileContent ReadHdf5Content(const std::string& path, const CsvLayout& layout);

}  // namespace warmjoint::inline models
