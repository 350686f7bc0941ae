#include "tools/store/database.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <cerrno>
#include <limits>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"

namespace warmjoint {
namespace fs = std::filesystem;
namespace {

/// Layout of the tables; raised whenever they change.
constexpr int kSchemaVersion = 4;
constexpr int kLargestValue = 64 << 20;  // bytes
constexpr int kLongestWait = 10'000;     // for another process, ms
constexpr const char* kRemedy = "run the suite anew in another directory";

// STRICT, so that the check of a damaged file finds values of another type
constexpr const char* kTables = R"sql(
  CREATE TABLE suite(yaml TEXT NOT NULL) STRICT;
  CREATE TABLE version(name TEXT PRIMARY KEY, value TEXT NOT NULL) STRICT, WITHOUT ROWID;
  CREATE TABLE realization(
    variant INTEGER, realization INTEGER, seconds REAL,
    PRIMARY KEY(variant, realization)) STRICT, WITHOUT ROWID;
  CREATE TABLE result(
    variant INTEGER, realization INTEGER, identifier INTEGER, status TEXT NOT NULL, message TEXT NOT NULL,
    seconds REAL, n INTEGER, parameters INTEGER, effective_parameters REAL, rmse REAL, mae REAL, fit REAL,
    fpe REAL, npe_continuous REAL, npe_discrete REAL, bound_npe_continuous REAL,
    bound_npe_discrete REAL, PRIMARY KEY(variant, realization, identifier)) STRICT, WITHOUT ROWID;
  CREATE TABLE parameter(
    variant INTEGER, realization INTEGER, identifier INTEGER, discrete INTEGER, position INTEGER,
    name TEXT NOT NULL, truth REAL, estimate REAL, estimated INTEGER, covered INTEGER, bound REAL,
    PRIMARY KEY(variant, realization, identifier, discrete, position)) STRICT, WITHOUT ROWID;
  CREATE TABLE measure(
    variant INTEGER, realization INTEGER, identifier INTEGER, position INTEGER, name TEXT NOT NULL, value REAL,
    PRIMARY KEY(variant, realization, identifier, position)) STRICT, WITHOUT ROWID;
  CREATE TABLE trace(
    variant INTEGER, realization INTEGER, identifier INTEGER, columns TEXT NOT NULL, float32 BLOB NOT NULL,
    PRIMARY KEY(variant, realization, identifier)) STRICT, WITHOUT ROWID;
)sql";

SQLite::Database Open(const fs::path& path, int flags) {
  // a killed writer's last batch is undone by whoever opens the file next, if it may
  SQLite::Database database(path.string(), flags, kLongestWait);
  sqlite3* handle = database.getHandle();
  // nothing of the file's own schema acts: no writes to it, no functions, triggers and views
  sqlite3_db_config(handle, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
  sqlite3_limit(handle, SQLITE_LIMIT_LENGTH, kLargestValue);
  sqlite3_limit(handle, SQLITE_LIMIT_ATTACHED, 1);

  // a batch survives the end of the process at any moment, and the loss of power up to the last
  database.exec("PRAGMA synchronous = NORMAL");
  const std::string answer = database.execAndGet("PRAGMA quick_check(1)").getString();
  if (answer != "ok") {
    Refuse({path.string()}, "is damaged: {}; {}", Excerpt(answer, kLongestComplaint), kRemedy);
  }
  return database;
}

bool IsEmpty(const SQLite::Database& database) {
  SQLite::Statement query(database, "SELECT count(*) FROM sqlite_schema");
  query.executeStep();
  return query.getColumn(0).getInt() == 0;
}

void CreateTables(SQLite::Database& database, const RunDescription& description) {
  // tables, their version and what the run is at once, or nothing
  SQLite::Transaction transaction(database);
  database.exec(kTables);
  database.exec(fmt::format("PRAGMA user_version = {}", kSchemaVersion));
  SQLite::Statement suite(database, "INSERT INTO suite VALUES (?)");
  suite.bind(1, description.suite_yaml);
  suite.exec();
  for (const auto& [name, value] : description.versions) {
    SQLite::Statement version(database, "INSERT INTO version VALUES (?, ?)");
    version.bind(1, name);
    version.bind(2, value);
    version.exec();
  }
  transaction.commit();
}

}  // namespace

SQLite::Database OpenDatabase(const fs::path& path) {
  return Guarded(path, [&] { return Open(path, SQLite::OPEN_READWRITE); });
}

SQLite::Database MakeDatabase(const fs::path& path, const RunDescription& description) {
  return Guarded(path, [&] {
    SQLite::Database database = Open(path, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    if (IsEmpty(database)) CreateTables(database, description);
    return database;
  });
}

RunDescription ReadDescription(const SQLite::Database& database, const fs::path& path) {
  return Guarded(path, [&] {
    // tables of another version are not looked at
    const Place place{path.string()};
    if (IsEmpty(database)) Refuse(place, "holds no results yet; run the suite again");
    SQLite::Statement stored(database, "PRAGMA user_version");
    stored.executeStep();
    if (const int version = stored.getColumn(0).getInt(); version != kSchemaVersion) {
      Refuse(place,
             "its tables are of schema version {}, this program reads version {}; read it with the "
             "program that made it, or {}",
             version, kSchemaVersion, kRemedy);
    }
    // the suite's one row, then what computed
    RunDescription description;
    SQLite::Statement suite(database, "SELECT yaml FROM suite");
    if (suite.executeStep()) description.suite_yaml = suite.getColumn(0).getString();
    SQLite::Statement row(database, "SELECT name, value FROM version ORDER BY name");
    while (row.executeStep()) {
      description.versions.emplace_back(row.getColumn(0).getString(), row.getColumn(1).getString());
    }
    return description;
  });
}

double NumberIn(const SQLite::Column& column) {
  return column.isNull() ? std::numeric_limits<double>::quiet_NaN() : column.getDouble();
}

void RethrowStoreError(const fs::path& path, const SQLite::Exception& error) {
  const Place place{path.string()};
  // a device that fails, a writer that does not end, a mistake of ours, or what the file holds
  switch (error.getErrorCode()) {
    case SQLITE_FULL:
      FailOutput(path.string(), ENOSPC);
    case SQLITE_IOERR:
      FailOutput(path.string(), EIO);
    case SQLITE_READONLY:
      if (fs::exists(path.string() + "-journal")) {
        Refuse(place,
               "a killed run left a batch that is to be undone, and you may not write there; let "
               "its owner read it, or go on with `warmjoint run`");
      }
      FailOutput(path.string(), EACCES);
    case SQLITE_PERM:
      FailOutput(path.string(), EACCES);
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      Refuse(place, "another process has been writing to it for {} s; try again",
             kLongestWait / 1000);
    case SQLITE_MISUSE:
      throw error;
    default:
      Refuse(place, "cannot be used as a run's database: {}; {}",
             Excerpt(error.what(), kLongestComplaint), kRemedy);
  }
}

}  // namespace warmjoint
