// Files and directories that appear whole or not at all, and files read as a whole.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace warmjoint {

/// A file under construction: write to it, then Commit() renames it onto the target. Without Commit
/// the destructor removes it, so a failure leaves nothing half-written behind.
///
/// The target is a new name or a regular file, whose mode is kept; links are followed. "-" and
/// /dev/stdout are standard output, which gets the bytes at Commit.
class AtomicFile {
 public:
  /// Throws BadInput for a target that is no regular file or whose folder cannot be written to;
  /// OutputFailed where the system has no room.
  explicit AtomicFile(const std::filesystem::path& target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// The file under construction, in the target's folder, with the target's extension. Its name is
  /// drawn, and it was made by this process alone: no link that someone planted leads elsewhere.
  const std::filesystem::path& temporary() const { return temporary_; }

  /// Adds bytes at the end. Throws OutputFailed.
  void Write(std::string_view bytes);

  /// Puts the finished file in place, on disk before it has its name. Throws OutputFailed.
  void Commit();

 private:
  std::string name_;              // of the target, as it was given
  std::filesystem::path target_;  // absolute, links followed; empty: standard output
  std::filesystem::path temporary_;
  int file_ = -1;
};

/// A directory under construction: fill temporary(), then Commit() puts it in the target's place.
/// Without Commit the destructor removes it, so a failure leaves nothing half-written behind.
class AtomicDirectory {
 public:
  /// Throws BadInput when the target exists and holds anything but files named in `replaceable`, or
  /// its parent folder does not exist or cannot be written to; OutputFailed where there is no room.
  AtomicDirectory(const std::filesystem::path& target, const std::vector<std::string>& replaceable);
  ~AtomicDirectory();
  AtomicDirectory(const AtomicDirectory&) = delete;
  AtomicDirectory& operator=(const AtomicDirectory&) = delete;

  /// Where to write to: a fresh directory beside the target, whose name is drawn.
  const std::filesystem::path& temporary() const { return temporary_; }

  /// Puts the finished directory in place, instead of an older one. Throws OutputFailed.
  void Commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path temporary_;
};

/// Whether an output's name stands for standard output: "-" or /dev/stdout.
bool IsStandardOutput(const std::filesystem::path& target);

/// Whether a file's name is that of an AtomicFile or AtomicDirectory under construction. One that
/// nobody is writing any more was left by a process that was killed.
bool IsUnderConstruction(const std::filesystem::path& path);

/// Writes `text` to `target` as a whole, as AtomicFile does.
void WriteWholeFile(const std::filesystem::path& target, std::string_view text);

/// Largest file that ReadWholeFile takes: 4 GiB.
inline constexpr std::size_t kLargestFile = std::size_t{4} << 30;

/// Whether an input's name stands for standard input: "-".
bool IsStandardInput(const std::filesystem::path& path);

/// An input as messages name it: its path, or "standard input".
std::string InputName(const std::filesystem::path& path);

/// The whole of a file, of a pipe, or of standard input. Throws BadInput naming the file when it cannot be read, is no file
/// or pipe, or has more than `most` bytes.
std::string ReadWholeFile(const std::filesystem::path& path, std::size_t most = kLargestFile);

}  // namespace warmjoint
