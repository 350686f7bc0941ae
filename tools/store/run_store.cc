#include "tools/store/run_store.h"

#include "models/foundation/atomic_file.h"
#include "tools/store/check_rows.h"
#include "tools/store/copy_rows.h"
#include "tools/store/digest.h"
#include "tools/store/schema.h"
#include "tools/store/shards_of.h"

namespace warmjoint::inline tools {
namespace {
namespace fs = std::filesystem;

constexpr const char* kResultsFile = "results.sqlite";
constexpr const char* kTimingsFile = "timings.sqlite";

std::optional<SQLite::Database> OpenTimings(const fs::path& path, Access access) {
  if (access != Access::write && !fs::exists(path)) return std::nullopt;
  return OpenDatabase(path, access);
}

/// Removes what a killed process was writing; the directory's lock is held.
void RemoveLeftovers(const fs::path& directory) {
  std::vector<fs::path> leftovers;
  for (const auto& entry : fs::recursive_directory_iterator(directory)) {
    if (IsUnderConstruction(entry.path())) leftovers.push_back(entry.path());
  }
  std::error_code ignored;
  for (const fs::path& path : leftovers) fs::remove_all(path, ignored);
}

/// Refuses a directory that holds other things than a run.
void MakeRunDirectory(const fs::path& directory) {
  // a directory, which is made where it is absent
  if (fs::exists(directory) && !fs::is_directory(directory)) {
    Refuse({directory.string()}, "is a file; a run needs a directory");
  }
  std::error_code error;
  fs::create_directories(directory, error);
  if (error) Refuse({directory.string()}, "cannot be made: {}", error.message());

  // a run goes on where there is one; any other folder has to be empty
  if (fs::exists(directory / kResultsFile)) return;
  for (const auto& entry : fs::directory_iterator(directory)) {
    if (entry.path().filename() == ".lock") continue;
    Refuse({directory.string()}, "holds '{}' and is no run directory; choose a new or empty one",
           entry.path().filename().string());
  }
}

}  // namespace

RunStore::RunStore(fs::path directory, Access access)
    : directory_(std::move(directory)),
      lock_(access == Access::write ? std::make_unique<DirectoryLock>(directory_) : nullptr),
      results_(OpenDatabase(results_file(), access)),
      timings_(OpenTimings(timings_file(), access)) {}

fs::path RunStore::results_file() const { return directory_ / kResultsFile; }

fs::path RunStore::timings_file() const { return directory_ / kTimingsFile; }

RunStore RunStore::CreateOrResume(const fs::path& directory, const RunDescription& description) {
  MakeRunDirectory(directory);
  RunStore store(directory, Access::write);
  RemoveLeftovers(directory);
  Guarded(directory, [&] {
    // a new run begins; an old one goes on where it is the same
    if (IsEmpty(store.results_)) {
      CreateResultTables(store.results_, description);
    } else {
      CheckSchema(store.results_, {store.results_file().string()});
      RefuseDifferentRun(store.ReadDescription(), description, {directory.string()});
      CheckRows(store.results_, description, {store.results_file().string()});
    }
    // timings may be lost without harm to the run
    if (IsEmpty(*store.timings_)) CreateTimingTables(*store.timings_);
    CheckTimingSchema(*store.timings_, {store.timings_file().string()});
  });
  store.plan_ = DigestOfPlan(description);

  // the suite as a file is for people: it is written anew from the database's where it differs
  const bool same =
      fs::exists(store.suite_file()) && ReadWholeFile(store.suite_file()) == description.suite_yaml;
  if (!same) WriteWholeFile(store.suite_file(), description.suite_yaml);
  return store;
}

RunStore RunStore::OpenToRead(const fs::path& directory, Access access) {
  const Place place{directory.string()};
  // tasks of an array leave shards, which are read as one run
  if (!fs::exists(directory / kResultsFile)) {
    const std::vector<fs::path> shards = ShardsOf(directory);
    if (!shards.empty()) return OpenShards(shards);
    Refuse(place, "is no run directory ({} is missing); give the -o of `warmjoint run`",
           kResultsFile);
  }
  RunStore store(directory, access);
  // tables that were changed after the run are refused
  Guarded(directory, [&] {
    if (IsEmpty(store.results_)) Refuse(place, "holds no results yet; run the suite again");
    CheckSchema(store.results_, {store.results_file().string()});
    CheckRows(store.results_, store.ReadDescription(), {store.results_file().string()});
    if (store.timings_) CheckTimingSchema(*store.timings_, {store.timings_file().string()});
  });
  return store;
}

RunStore RunStore::OpenShards(const std::vector<fs::path>& shards) {
  // copies, since tasks put newer files in their place meanwhile
  auto folder = std::make_shared<TemporaryFolder>("shards");
  std::vector<fs::path> copies;
  for (const fs::path& shard : shards) {
    copies.push_back(folder->path() / shard.filename());
    fs::create_directory(copies.back());
    for (const char* name : {kTimingsFile, kResultsFile}) {
      if (fs::exists(shard / name)) fs::copy_file(shard / name, copies.back() / name);
    }
  }
  // all shards have to be of one run
  const RunDescription description = OpenToRead(copies.front()).ReadDescription();
  for (std::size_t i = 0; i < copies.size(); ++i) {
    RefuseDifferentRun(description, OpenToRead(copies[i]).ReadDescription(), {shards[i].string()});
  }
  // their rows in one store, which owns the folder that it lies in
  RunStore whole = CreateOrResume(folder->path() / "run", description);
  whole.Gather(copies, Overlap::equal);
  whole.folder_ = std::move(folder);
  return whole;
}

RunDescription RunStore::ReadDescription() const { return ReadStoredDescription(results_); }

void RunStore::Settle() { WriteAnew({SourceOf(results_file())}, Overlap::refused); }

void RunStore::Gather(const std::vector<fs::path>& shards, Overlap overlap) {
  std::vector<RowSource> results, timings;
  for (const fs::path& shard : shards) {
    // results are all that a shard must have
    results.push_back(SourceOf(shard / kResultsFile));
    if (!fs::exists(shard / kTimingsFile)) continue;
    timings.push_back({shard / kTimingsFile, results.back().first});
  }
  Guarded(timings_file(), [&] { CopyTimings(*timings_, timings); });
  WriteAnew(results, overlap);
}

void RunStore::WriteAnew(const std::vector<RowSource>& sources, Overlap overlap) {
  const RunDescription description = ReadDescription();
  AtomicFile file(results_file());
  Guarded(results_file(), [&] {
    SQLite::Database fresh = OpenDatabase(file.temporary(), Access::write);
    // nobody else sees it before it is whole, and Commit() puts it on disk
    fresh.exec("PRAGMA journal_mode = MEMORY; PRAGMA synchronous = OFF");
    CreateResultTables(fresh, description);
    CopyResults(fresh, sources, overlap);
  });
  // closed while the file is replaced
  results_ = SQLite::Database(":memory:");
  file.Commit();
  results_ = OpenDatabase(results_file(), Access::write);
}

}  // namespace warmjoint::inline tools
