// Files that appear whole or not at all.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace warmjoint::inline models {

/// A file under construction: write to temporary(), then Commit() renames it onto the target.
/// Without Commit the destructor removes it, so a failure leaves nothing half-written behind.
class AtomicFile {
 public:
  /// Throws BadInput when the target's folder does not exist or cannot be written.
  explicit AtomicFile(std::filesystem::path target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Path to write to, in the target's folder, with the target's extension.
  const std::filesystem::path& temporary() const { return temporary_; }

  /// Moves the finished file into place. Throws BadInput when the system refuses.
  void Commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path temporary_;
};

/// Writes `text` to `target` as a whole.
void WriteWholeFile(const std::filesystem::path& target, std::string_view text);

/// The whole of a text file. Throws BadInput naming the file when it cannot be read.
std::string ReadWholeFile(const std::filesystem::path& path);

}  // namespace warmjoint::inline models
