// What keeps commands of others away from everything but their own directory.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace warmjoint::inline tools {

/// What the kernel's Landlock can hold here: 0 where there is none; from 1 on files; from 4 on network
/// (TCP); from 6 on signals to processes outside.
int WallVersion();

/// What a wall is made of.
enum class WallKind { none, landlock, bubblewrap };

/// The best that stands here: Landlock, else bubblewrap (bubble.h). WARMJOINT_WALL=bubblewrap in the environment
/// prefers that one.
WallKind BestWall();

/// In a sentence, for those who run commands of others: which wall stands, or that none does.
std::string WallInWords();

/// Whether the wall keeps a file or folder out of sight: all but what an operating system brings and
/// what is named as readable.
bool WallHides(const std::filesystem::path& path,
               const std::vector<std::filesystem::path>& readable);

/// A wall that was made and not yet raised. Behind it a process and its children can read and execute
/// what an operating system brings (/usr, /etc, ...), read what is named as readable, and read and
/// write their own directory; they can trace and signal no process outside, and open no connection.
/// /proc is closed, so that no process's memory, arguments, environment or files are within reach.
class Wall {
 public:
  /// readable: files and folders. own: the directory that belongs to the command.
  Wall(const std::vector<std::filesystem::path>& readable, const std::filesystem::path& own,
       WallKind kind = BestWall());
  /// None: for what is trusted.
  Wall() = default;
  ~Wall();
  Wall(const Wall&) = delete;
  Wall& operator=(const Wall&) = delete;

  /// The command that runs behind it: the same, or another one that makes the wall first.
  std::vector<std::string> Around(std::vector<std::string> command) const;

  /// Raises it around the calling process for the rest of its life; false where that fails. Safe
  /// between fork and exec. Does nothing, and well, where the kernel has no wall.
  bool Raise() const noexcept;

  /// The ruleset's descriptor, which has to stay open until Raise; -1 without a wall.
  int descriptor() const { return ruleset_; }

 private:
  int ruleset_ = -1;
  bool bubble_ = false;
  std::vector<std::filesystem::path> readable_{};  // of a bubble
  std::filesystem::path own_{};
};

}  // namespace warmjoint::inline tools
