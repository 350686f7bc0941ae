#include "tools/suite/working_directory.h"

#include <stdlib.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "models/foundation/output_failed.h"

namespace warmjoint::inline tools {

WorkingDirectory::WorkingDirectory() {
  std::string pattern = std::filesystem::temp_directory_path() / "warmjoint_XXXXXX";
  if (!mkdtemp(pattern.data())) FailOutput(pattern, errno);
  path_ = pattern;
}

WorkingDirectory::~WorkingDirectory() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace warmjoint::inline tools
