// The database of a run, as SQLite keeps it; it may come from strangers.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>

#include "tools/store/run_store.h"

namespace warmjoint {

/// Opens a database so that its schema can do nothing: no triggers, views or functions of its own, no
/// value beyond 64 MiB. Waits up to 10 s for another process's batch. Throws BadInput for a file that
/// is missing, is no database or is damaged (PRAGMA quick_check).
SQLite::Database OpenDatabase(const std::filesystem::path& path);

/// The same; a file that is missing is made, and an empty one gets the tables of a run and its
/// description, as a whole or not at all. Throws OutputFailed where there is no room.
SQLite::Database MakeDatabase(const std::filesystem::path& path, const RunDescription& description);

/// The description that MakeDatabase stored. Throws BadInput for a database without results, and for
/// tables of another version than this program's (PRAGMA user_version).
RunDescription ReadDescription(const SQLite::Database& database, const std::filesystem::path& path);

/// The tables that hold rows of realizations.
inline constexpr const char* kRowTables[]{"realization", "result", "parameter", "measure", "trace"};

/// A stored number; NULL stands for NaN.
double NumberIn(const SQLite::Column& column);

/// Throws OutputFailed where the system has no room or refuses to write, and BadInput for what the
/// file's content causes, with what SQLite says of it.
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

}  // namespace warmjoint
