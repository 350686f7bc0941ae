#include "tools/store/folders.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "models/foundation/bad_input.h"

namespace warmjoint {

DirectoryLock::DirectoryLock(const std::filesystem::path& directory) {
  const std::filesystem::path path = directory / ".lock";
  // the kernel lets go of the lock with its process, however that ends
  file_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0644);
  if (file_ < 0) Refuse({directory.string()}, "cannot be written to: {}", std::strerror(errno));
  if (flock(file_, LOCK_EX | LOCK_NB) != 0) {
    close(file_);
    Refuse({directory.string()}, "another run is writing to it; wait for it or choose another");
  }
}

DirectoryLock::~DirectoryLock() { close(file_); }

TemporaryFolder::TemporaryFolder(const std::string& what) {
  std::string pattern = std::filesystem::temp_directory_path() / ("warmjoint-" + what + "-XXXXXX");
  if (!mkdtemp(pattern.data())) FailOutput(pattern, errno);
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace warmjoint
