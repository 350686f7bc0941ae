#include "tools/store/run_store.h"

#include "models/foundation/atomic_file.h"
#include "tools/store/schema.h"

namespace warmjoint::inline tools {
namespace {
namespace fs = std::filesystem;

constexpr const char* kResultsFile = "results.sqlite";
constexpr const char* kTimingsFile = "timings.sqlite";
const int kCreate = SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE;

SQLite::Database OpenDatabase(const fs::path& path, int flags) {
  try {
    SQLite::Database database(path.string(), flags);
    // a batch survives the end of the process at any moment, and the loss of power up to the last
    database.exec("PRAGMA synchronous = NORMAL");
    IsEmpty(database);  // reads the file's head, so that a damaged one is found here
    return database;
  } catch (const SQLite::Exception& error) {
    Refuse({path.string()}, "cannot be opened as a database: {}", error.what());
  }
}

/// Refuses a directory that holds other things than a run.
void MakeRunDirectory(const fs::path& directory) {
  if (fs::exists(directory) && !fs::is_directory(directory)) {
    Refuse({directory.string()}, "is a file; a run needs a directory");
  }
  std::error_code error;
  fs::create_directories(directory, error);
  if (error) Refuse({directory.string()}, "cannot be made: {}", error.message());

  if (fs::exists(directory / kResultsFile)) return;
  for (const auto& entry : fs::directory_iterator(directory)) {
    if (entry.path().filename() == ".lock") continue;
    Refuse({directory.string()}, "holds '{}' and is no run directory; choose a new or empty one",
           entry.path().filename().string());
  }
}

}  // namespace

RunStore::RunStore(fs::path directory, int open_flags)
    : directory_(std::move(directory)),
      lock_(open_flags == kCreate ? std::make_unique<DirectoryLock>(directory_) : nullptr),
      results_(OpenDatabase(directory_ / kResultsFile, open_flags)),
      timings_(OpenDatabase(directory_ / kTimingsFile, kCreate)) {}

RunStore RunStore::CreateOrResume(const fs::path& directory, const RunDescription& description) {
  MakeRunDirectory(directory);
  RunStore store(directory, kCreate);
  if (IsEmpty(store.results_)) {
    CreateResultTables(store.results_, description);
  } else {
    CheckSchema(store.results_, {directory.string()});
    RefuseDifferentRun(store.ReadDescription(), description, {directory.string()});
  }
  CreateTimingTables(store.timings_);

  // the suite as a file is for people: it is written anew from the database's
  WriteWholeFile(store.suite_file(), description.suite_yaml);
  return store;
}

RunStore RunStore::OpenToRead(const fs::path& directory) {
  const Place place{directory.string()};
  if (!fs::exists(directory / kResultsFile)) {
    Refuse(place, "is no run directory ({} is missing); give the -o of `warmjoint run`",
           kResultsFile);
  }
  RunStore store(directory, SQLite::OPEN_READWRITE);
  if (IsEmpty(store.results_)) Refuse(place, "holds no results yet; run the suite again");
  CheckSchema(store.results_, place);
  return store;
}

RunDescription RunStore::ReadDescription() const { return ReadStoredDescription(results_); }

}  // namespace warmjoint::inline tools
