// Databases that may come from strangers.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>

namespace warmjoint::inline tools {

/// What is done with a database.
enum class Access {
  read,    // needs no right to write, unless a killed writer's last batch has to be undone
  frozen,  // nobody writes to it: no locks are asked for, which network file systems may not have
  write,   // made where it is absent
};

/// Opens a database so that its schema can do nothing: no triggers, views or functions of its own, no
/// value beyond 64 MiB. Waits up to 10 s for another process's batch. Throws BadInput for a file that
/// is no database or fails SQLite's integrity check.
SQLite::Database OpenDatabase(const std::filesystem::path& path, Access access);

/// As OpenDatabase with Access::frozen, without the integrity check: for what was opened before.
SQLite::Database ReopenFrozen(const std::filesystem::path& path);

/// Throws OutputFailed where the system has no room or refuses to write, BadInput for what a file's
/// content causes, and `error` itself else.
[[noreturn]] void RethrowStoreError(const std::filesystem::path& path,
                                    const SQLite::Exception& error);

/// Does `work` on the database at `path`; its failures become those of RethrowStoreError.
template <typename Work>
auto Guarded(const std::filesystem::path& path, Work work) {
  try {
    return work();
  } catch (const SQLite::Exception& error) {
    RethrowStoreError(path, error);
  }
}

}  // namespace warmjoint::inline tools
