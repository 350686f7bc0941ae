// Databases that may come from strangers.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>

namespace warmjoint::inline tools {

/// What is done with a database.
enum class Access {
  read,   // needs no right to write, unless a killed writer's last batch has to be undone
  write,  // made where it is absent
};

/// Opens a database so that its schema can do nothing: no triggers, views or functions of its own, no
/// value beyond 64 MiB. Waits up to 10 s for another process's batch. Throws BadInput for a file that
/// is no database or fails SQLite's integrity check.
SQLite::Database OpenDatabase(const std::filesystem::path& path, Access access);

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
