// Reading by a library that may crash, in a process of its own.
#pragma once

#include <string>

#include "models/recording/assemble.h"

namespace warmjoint {

/// A format that a library reads.
struct FileFormat {
  const char* name = "";  // in messages
  FileContent (*read)(const std::string& path, const ReadSettings& layout) = nullptr;
};

/// Reads in a child process with limits on memory (8 GiB besides what this process has) and time
/// (patience, s, and 1 s for each 10 MB of the file): crash and hang become BadInput.
FileContent ReadApart(const FileFormat& format, const std::string& path, const ReadSettings& layout,
                      double patience);

}  // namespace warmjoint
