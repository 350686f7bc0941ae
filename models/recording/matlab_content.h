// The columns of a MATLAB file.
#pragma once

#include <string>

#include "models/recording/file_content.h"

namespace warmjoint::inline models {

/// Reads vectors of real numbers, at the top or in structs of one element, and what the file says of joint,
/// gear and units (matlab.h). Within this process for files of one's own. Throws BadInput, also where the
/// layout's columns are not there or have more than kMostSamples. One thread at a time.
FileContent ReadMatlabContent(const std::string& path, const CsvLayout& layout);

}  // namespace warmjoint::inline models
