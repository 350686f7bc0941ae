// Directories that appear whole or not at all.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace warmjoint::inline models {

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

}  // namespace warmjoint::inline models
