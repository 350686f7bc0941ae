// One writer for each run directory.
#pragma once

#include <filesystem>

namespace warmjoint::inline tools {

/// Holds DIR/.lock while it lives. The system lets go of it when the process ends, however it ends.
class DirectoryLock {
 public:
  /// Throws BadInput when another process holds the lock.
  explicit DirectoryLock(const std::filesystem::path& directory);
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

 private:
  int file_ = -1;
};

}  // namespace warmjoint::inline tools
