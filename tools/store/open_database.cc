#include "tools/store/open_database.h"

#include <sqlite3.h>

#include <array>
#include <cerrno>
#include <fstream>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/output_failed.h"

namespace warmjoint::inline tools {
namespace fs = std::filesystem;
namespace {

constexpr int kLargestValue = 64 << 20;  // bytes
constexpr int kPatience = 10'000;        // ms

/// Takes from the file's own schema all that could act.
void Disarm(SQLite::Database& database) {
  // no writes to the schema's own tables, no functions, triggers and views of the file
  sqlite3* handle = database.getHandle();
  sqlite3_db_config(handle, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);

  // and no value or other database that would take the memory
  sqlite3_limit(handle, SQLITE_LIMIT_LENGTH, kLargestValue);
  sqlite3_limit(handle, SQLITE_LIMIT_ATTACHED, 1);
}

void CheckIntegrity(const SQLite::Database& database, const fs::path& path) {
  SQLite::Statement check(database, "PRAGMA integrity_check(1)");
  check.executeStep();
  const std::string answer = check.getColumn(0).getString();
  if (answer == "ok") return;
  Refuse({path.string()}, "is damaged: {}; run the suite anew in another directory",
         Excerpt(answer, kLongestComplaint));
}

/// Refuses SQLite's write-ahead mode, which another program set: it keeps rows in files of its own beside this one.
void RefuseWriteAhead(const fs::path& path) {
  // the header's byte 19 tells how the file is to be read
  std::array<char, 20> header{};
  std::ifstream(path, std::ios::binary).read(header.data(), header.size());
  constexpr char write_ahead = 2;  // version of the format, for readers
  if (header[19] != write_ahead) return;
  Refuse({path.string()},
         "is in SQLite's write-ahead mode, which another program set; do `PRAGMA journal_mode = "
         "DELETE` with it");
}

SQLite::Database OpenUnchecked(const fs::path& path, int flags, const char* locking) {
  RefuseWriteAhead(path);
  SQLite::Database database(path.string(), flags, kPatience, locking);
  Disarm(database);
  return database;
}

SQLite::Database Open(const fs::path& path, int flags, const char* locking) {
  SQLite::Database database = OpenUnchecked(path, flags, locking);
  // a batch survives the end of the process at any moment, and the loss of power up to the last
  database.exec("PRAGMA synchronous = NORMAL");
  CheckIntegrity(database, path);
  return database;
}

constexpr const char* kLocks = "unix";
constexpr const char* kNoLocks = "unix-none";

int FlagsOf(Access access) {
  return access == Access::write ? SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE
                                 : SQLite::OPEN_READONLY;
}

}  // namespace

void RethrowStoreError(const fs::path& path, const SQLite::Exception& error) {
  const Place place{path.string()};
  // a device that fails, a writer that does not end, a mistake of ours, or a file that is none
  switch (error.getErrorCode()) {
    case SQLITE_FULL:
      FailOutput(path.string(), ENOSPC);
    case SQLITE_IOERR:
      FailOutput(path.string(), EIO);
    case SQLITE_READONLY:
    case SQLITE_PERM:
      FailOutput(path.string(), EACCES);
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      Refuse(place, "another process has been writing to it for {} s; try again", kPatience / 1000);
    case SQLITE_CONSTRAINT:
    case SQLITE_MISUSE:
      throw error;  // ours
    default:
      Refuse(place, "cannot be read as a database: {}", Excerpt(error.what(), kLongestComplaint));
  }
}

SQLite::Database OpenDatabase(const fs::path& path, Access access) {
  try {
    return Open(path, FlagsOf(access), access == Access::frozen ? kNoLocks : kLocks);
  } catch (const SQLite::Exception& error) {
    // a killed writer left a batch that only one who may write can undo
    const bool left = access == Access::read && fs::exists(path.string() + "-journal");
    if (!left) {
      Refuse({path.string()}, "cannot be opened as a database: {}",
             Excerpt(error.what(), kLongestComplaint));
    }
  }
  return Guarded(path, [&] { return Open(path, SQLite::OPEN_READWRITE, kLocks); });
}

SQLite::Database ReopenFrozen(const fs::path& path) {
  return Guarded(path, [&] { return OpenUnchecked(path, SQLite::OPEN_READONLY, kNoLocks); });
}

}  // namespace warmjoint::inline tools
