// Where a command of others works.
#pragma once

#include <filesystem>

namespace warmjoint::inline tools {

/// A fresh directory within the system's for temporary files, removed at the end of its life, and with this process
/// however that ends. Throws OutputFailed where none can be made.
class WorkingDirectory {
 public:
  WorkingDirectory();
  ~WorkingDirectory();
  WorkingDirectory(const WorkingDirectory&) = delete;
  WorkingDirectory& operator=(const WorkingDirectory&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace warmjoint::inline tools
