// Folders that a process has for itself.
#pragma once

#include <filesystem>
#include <string>

namespace warmjoint {

/// One writer for each run directory: holds DIR/.lock while it lives. The system releases it when the
/// process ends, however it ends.
class DirectoryLock {
 public:
  /// Throws BadInput when another process holds the lock, or the directory cannot be written to.
  explicit DirectoryLock(const std::filesystem::path& directory);
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

 private:
  int file_ = -1;
};

/// An empty folder on this machine's own disk (TMPDIR), open to this user alone; removed with all it
/// holds at the end of its life.
class TemporaryFolder {
 public:
  /// what: part of its name. Throws OutputFailed where it cannot be made.
  explicit TemporaryFolder(const std::string& what);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace warmjoint
