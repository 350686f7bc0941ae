// Where a task works: a folder on the machine's own disk.
#pragma once

#include <filesystem>

#include "tools/cluster/plan.h"

namespace warmjoint::inline tools {

/// TMPDIR/warmjoint-USER/PLAN/NUMBER, open to this user alone. It has the same name each time, so that a
/// task that is started again on its machine loses nothing. SQLite does not run on RUN itself, which may
/// lie on a network file system.
class TaskFolder {
 public:
  /// Makes the folder, and waits up to 20 s for what still holds its store. Throws BadInput where the
  /// folder is someone else's.
  TaskFolder(const Plan& plan, int number);

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path store() const { return path_ / "run"; }

  /// Whether a store was left here that can be gone on with.
  bool HasStore() const;

  /// Puts the run's copy of the store here, in place of what is here; none where the run has none.
  void FetchStore(const std::filesystem::path& shard_folder) const;

  /// Removes all of it.
  void Remove() const;

 private:
  std::filesystem::path path_;
};

}  // namespace warmjoint::inline tools
