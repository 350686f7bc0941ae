// A folder of this process alone, for as long as it is needed.
#pragma once

#include <filesystem>
#include <string>

namespace warmjoint::inline tools {

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

}  // namespace warmjoint::inline tools
