// Logs in formats that Python's libraries read (tools/python/warmjoint/formats).
#pragma once

#include <filesystem>
#include <string>

#include "models/recording/assemble.h"

namespace warmjoint {

/// What is asked of a file of another format.
struct OtherFormat {
  std::string file;
  std::string topic, joint;  // of a bag; empty: the only topic of joints, all joints
  ColumnTexts map{};         // ours -> theirs; empty: all columns by their own names
};

/// Reads columns in a child process: by the Python that WARMJOINT_PYTHON names, else by python3 in PATH, else by /usr/bin/python3. The child
/// bounds its own memory and time. Throws BadInput with the reader's sentence, and where it crashes or takes too long.
FileContent ReadOtherFormat(const OtherFormat& asked);

}  // namespace warmjoint
