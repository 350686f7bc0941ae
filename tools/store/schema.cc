#include "tools/store/schema.h"

#include <fmt/format.h>

#include <algorithm>

#include "models/foundation/excerpt.h"

namespace warmjoint::inline tools {
namespace {

// STRICT, so that the integrity check finds values of another type
constexpr const char* kResultTables = R"sql(
  CREATE TABLE suite(yaml TEXT NOT NULL) STRICT;
  CREATE TABLE version(name TEXT PRIMARY KEY, value TEXT NOT NULL) STRICT, WITHOUT ROWID;
  CREATE TABLE identifier(position INTEGER PRIMARY KEY, label TEXT NOT NULL) STRICT;
  CREATE TABLE variant(position INTEGER PRIMARY KEY, name TEXT NOT NULL) STRICT;
  CREATE TABLE realization(
    variant INTEGER, realization INTEGER, digest TEXT NOT NULL,
    PRIMARY KEY(variant, realization)) STRICT, WITHOUT ROWID;
  CREATE TABLE result(
    variant INTEGER, realization INTEGER, identifier INTEGER, status TEXT NOT NULL, message TEXT NOT NULL,
    n INTEGER, parameters INTEGER, effective_parameters REAL, rmse REAL, mae REAL, fit REAL,
    fpe REAL, npe_continuous REAL, npe_discrete REAL, bound_npe_continuous REAL,
    bound_npe_discrete REAL, PRIMARY KEY(variant, realization, identifier)) STRICT, WITHOUT ROWID;
  CREATE TABLE parameter(
    variant INTEGER, realization INTEGER, identifier INTEGER, discrete INTEGER, position INTEGER,
    name TEXT NOT NULL, truth REAL, estimate REAL, estimated INTEGER, covered INTEGER, bound REAL,
    PRIMARY KEY(variant, realization, identifier, discrete, position)) STRICT, WITHOUT ROWID;
  CREATE TABLE trace(
    variant INTEGER, realization INTEGER, identifier INTEGER, columns TEXT NOT NULL, float32 BLOB NOT NULL,
    digest TEXT NOT NULL, PRIMARY KEY(variant, realization, identifier)) STRICT, WITHOUT ROWID;
)sql";

constexpr const char* kTimingTables = R"sql(
  CREATE TABLE identification(
    variant INTEGER, realization INTEGER, identifier INTEGER, seconds REAL,
    PRIMARY KEY(variant, realization, identifier)) STRICT, WITHOUT ROWID;
  CREATE TABLE simulation(
    variant INTEGER, realization INTEGER, seconds REAL,
    PRIMARY KEY(variant, realization)) STRICT, WITHOUT ROWID;
)sql";

/// What a database's schema holds, besides what SQLite keeps for itself: "type name: sql" each.
std::vector<std::string> ObjectsOf(const SQLite::Database& database) {
  std::vector<std::string> objects;
  SQLite::Statement row(database,
                        "SELECT type || ' ' || name || ': ' || coalesce(sql, '') FROM sqlite_schema"
                        " ORDER BY type, name");
  while (row.executeStep()) objects.push_back(row.getColumn(0).getString());
  return objects;
}

/// Refuses tables that are not those that `create` makes: other columns, views, triggers.
void RefuseForeignObjects(const SQLite::Database& database, const char* create,
                          const Place& place) {
  // the tables as this version makes them
  SQLite::Database ours(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  ours.exec(create);
  const std::vector<std::string> expected = ObjectsOf(ours);
  for (const std::string& object : ObjectsOf(database)) {
    if (std::find(expected.begin(), expected.end(), object) != expected.end()) continue;
    Refuse(place, "holds a foreign '{}' in its schema; it was changed after the run",
           Excerpt(object));
  }
  // all there are belong to a run, but some may be gone
  if (ObjectsOf(database) == expected) return;
  Refuse(place, "lacks some of its tables; it was changed after the run, or is no run's");
}

int UserVersion(const SQLite::Database& database) {
  SQLite::Statement query(database, "PRAGMA user_version");
  query.executeStep();
  return query.getColumn(0).getInt();
}

/// Rows of (position, name).
void InsertNames(SQLite::Database& database, const char* insert,
                 const std::vector<std::string>& names) {
  for (size_t i = 0; i < names.size(); ++i) {
    SQLite::Statement row(database, insert);
    row.bind(1, static_cast<int>(i));
    row.bind(2, names[i]);
    row.exec();
  }
}

std::vector<std::string> ReadNames(const SQLite::Database& database, const char* query) {
  std::vector<std::string> names;
  SQLite::Statement row(database, query);
  while (row.executeStep()) names.push_back(row.getColumn(0).getString());
  return names;
}

}  // namespace

void CreateResultTables(SQLite::Database& results, const RunDescription& description) {
  // tables and their version at once, or neither
  SQLite::Transaction transaction(results);
  results.exec(kResultTables);
  results.exec(fmt::format("PRAGMA user_version = {}", kSchemaVersion));

  // what the run is: its suite, its versions, and the names that numbers stand for
  SQLite::Statement suite(results, "INSERT INTO suite VALUES (?)");
  suite.bind(1, description.suite_yaml);
  suite.exec();
  for (const auto& [name, value] : description.versions) {
    SQLite::Statement version(results, "INSERT INTO version VALUES (?, ?)");
    version.bind(1, name);
    version.bind(2, value);
    version.exec();
  }
  // numbers in all other tables stand for these names
  InsertNames(results, "INSERT INTO identifier VALUES (?, ?)", description.identifiers);
  InsertNames(results, "INSERT INTO variant VALUES (?, ?)", description.variants);
  transaction.commit();
}

void CreateTimingTables(SQLite::Database& timings) {
  SQLite::Transaction transaction(timings);
  timings.exec(kTimingTables);
  transaction.commit();
}

bool IsEmpty(const SQLite::Database& database) {
  SQLite::Statement query(database, "SELECT count(*) FROM sqlite_master");
  query.executeStep();
  return query.getColumn(0).getInt() == 0;
}

void CheckSchema(const SQLite::Database& results, const Place& place) {
  const int version = UserVersion(results);
  if (version != kSchemaVersion) {
    Refuse(place,
           "its tables are of schema version {}, this program reads version {}; read it with the "
           "program that made it, or run the suite anew in another directory",
           version, kSchemaVersion);
  }
  RefuseForeignObjects(results, kResultTables, place);
}

void CheckTimingSchema(const SQLite::Database& timings, const Place& place) {
  RefuseForeignObjects(timings, kTimingTables, place);
}

RunDescription ReadStoredDescription(const SQLite::Database& results) {
  RunDescription description;
  // the suite's one row, then the lists of names
  SQLite::Statement suite(results, "SELECT yaml FROM suite");
  while (suite.executeStep()) description.suite_yaml = suite.getColumn(0).getString();

  SQLite::Statement version(results, "SELECT name, value FROM version ORDER BY name");
  while (version.executeStep()) {
    description.versions.emplace_back(version.getColumn(0).getString(),
                                      version.getColumn(1).getString());
  }
  description.identifiers = ReadNames(results, "SELECT label FROM identifier ORDER BY position");
  description.variants = ReadNames(results, "SELECT name FROM variant ORDER BY position");
  return description;
}

}  // namespace warmjoint::inline tools
