#include "tools/store/temporary_folder.h"

#include <stdlib.h>

#include <cerrno>

#include "models/foundation/output_failed.h"

namespace warmjoint::inline tools {

TemporaryFolder::TemporaryFolder(const std::string& what) {
  std::string pattern = std::filesystem::temp_directory_path() / ("warmjoint-" + what + "-XXXXXX");
  if (!mkdtemp(pattern.data())) FailOutput(pattern, errno);
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace warmjoint::inline tools
