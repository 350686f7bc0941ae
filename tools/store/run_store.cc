#include "tools/store/run_store.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "models/foundation/atomic_file.h"
#include "models/foundation/excerpt.h"
#include "scenarios/yaml.h"
#include "tools/store/database.h"
#include "tools/terminal/say.h"

namespace warmjoint {
namespace {

/// Values of a YAML document by their dotted paths.
using ScalarsByPath = std::map<std::string, std::string>;

void Flatten(const Tree& tree, const std::string& path, ScalarsByPath& scalars) {
  const std::string prefix = path.empty() ? "" : path + ".";
  if (!tree.is_structured()) scalars[path] = tree.is_null() ? "nothing" : tree.get<std::string>();
  for (const auto& [name, value] : tree.items()) {
    if (tree.is_structured()) Flatten(value, prefix + name, scalars);
  }
}

ScalarsByPath ScalarsOf(const std::string& yaml, const char* what) {
  ScalarsByPath scalars;
  Flatten(ParseYaml(yaml, what).tree(), "", scalars);
  return scalars;
}

std::string ValueOrNothing(const ScalarsByPath& scalars, const std::string& path) {
  const auto found = scalars.find(path);
  return found == scalars.end() ? "nothing" : found->second;
}

/// What differs, one "path: old in the directory, new asked" each.
std::vector<std::string> Differences(const ScalarsByPath& before, const ScalarsByPath& after) {
  // paths of either suite, since both may lack some
  ScalarsByPath paths = before;
  paths.insert(after.begin(), after.end());
  std::vector<std::string> differences;
  for (const auto& [path, value] : paths) {
    const std::string old_value = ValueOrNothing(before, path);
    const std::string new_value = ValueOrNothing(after, path);
    if (old_value == new_value) continue;
    differences.push_back(
        fmt::format("{}: {} in the directory, {} asked", path, old_value, new_value));
  }
  return differences;
}

namespace fs = std::filesystem;

constexpr const char* kResultsFile = "results.sqlite";

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

/// Refuses a result that the suite has no place for: from here on every number is an index into its lists.
void RefuseMisplaced(const SQLite::Database& database, const Suite& suite, const fs::path& file) {
  SQLite::Statement row(
      database,
      "SELECT variant, realization, identifier FROM result WHERE NOT (variant >= 0 AND variant < ? "
      "AND realization >= 0 AND realization < ? AND identifier >= 0 AND identifier < ?) LIMIT 1");
  row.bind(1, suite.variants());
  row.bind(2, suite.realizations);
  row.bind(3, static_cast<int>(suite.identifiers.size()));
  if (!row.executeStep()) return;
  Refuse({file.string()},
         "holds a result of variant {}, realization {}, identifier {}, which its suite does not "
         "have; run the suite anew in another directory",
         row.getColumn(0).getInt64(), row.getColumn(1).getInt64(), row.getColumn(2).getInt64());
}

/// Refuses a realization that the attached shard and the run both hold.
void RefuseOverlap(const SQLite::Database& database, const fs::path& shard) {
  SQLite::Statement both(database,
                         "SELECT realization FROM shard.realization JOIN main.realization USING "
                         "(variant, realization) LIMIT 1");
  if (!both.executeStep()) return;
  Refuse({shard.string()},
         "holds realization {}, which another shard holds as well; merge each shard once",
         both.getColumn(0).getInt());
}

}  // namespace

void RefuseDifferentRun(const RunDescription& stored, const RunDescription& asked,
                        const Place& place) {
  // results of other versions do not mix; the versions asked for are this program's own
  if (stored.versions != asked.versions) {
    std::string made;
    for (const auto& [name, value] : stored.versions) made += fmt::format(" {} {}", name, value);
    Refuse(place, "was made with{}, which does not mix with this; run in another directory", made);
  }
  ScalarsByPath before;
  try {
    before = ScalarsOf(stored.suite_yaml, "the stored suite");
  } catch (const BadInput& unreadable) {
    Refuse(place, "holds no suite that can be read ({})", unreadable.what());
  }
  const ScalarsByPath after = ScalarsOf(asked.suite_yaml, "the suite");
  std::vector<std::string> differences = Differences(before, after);
  if (differences.empty()) return;

  // another name says more than all that differs
  const std::string old_name = ValueOrNothing(before, "name");
  const std::string new_name = ValueOrNothing(after, "name");
  if (old_name != new_name) {
    Refuse(place, "was made by suite {}, and this is {}; choose another directory",
           Excerpt(old_name), Excerpt(new_name));
  }
  // two differences say enough
  const size_t shown = std::min<size_t>(differences.size(), 2);
  const std::string more =
      differences.size() > shown ? fmt::format("; and {} more", differences.size() - shown) : "";
  differences.resize(shown);
  Refuse(place, "holds another run ({}{}); resume it as it was started or choose another directory",
         fmt::join(differences, "; "), more);
}

RunStore::RunStore(fs::path directory, SQLite::Database database)
    : directory_(std::move(directory)),
      database_(std::move(database)),
      description_(ReadDescription(database_, results_file())),
      suite_(ParseSuite(description_.suite_yaml, results_file())) {
  Guarded(results_file(), [&] { RefuseMisplaced(database_, suite_, results_file()); });
}

fs::path RunStore::results_file() const { return directory_ / kResultsFile; }

RunStore RunStore::CreateOrResume(const fs::path& directory, const RunDescription& description) {
  // nobody else writes to it from here on
  MakeRunDirectory(directory);
  auto lock = std::make_unique<DirectoryLock>(directory);
  RemoveLeftovers(directory);
  RunStore store(directory, MakeDatabase(directory / kResultsFile, description));
  store.lock_ = std::move(lock);
  RefuseDifferentRun(store.description_, description, {directory.string()});

  // the suite as a file is for people: it is written anew from the database's where it differs
  const bool same =
      fs::exists(store.suite_file()) && ReadWholeFile(store.suite_file()) == description.suite_yaml;
  if (!same) WriteWholeFile(store.suite_file(), description.suite_yaml);
  return store;
}

RunStore RunStore::OpenToRead(const fs::path& directory) {
  // tasks of an array leave shards, which are read as one run
  if (!fs::exists(directory / kResultsFile)) {
    const std::vector<fs::path> shards = ShardsOf(directory);
    if (!shards.empty()) return OpenShards(shards);
    Refuse({directory.string()},
           "is no run directory ({} is missing); give the -o of `warmjoint run`", kResultsFile);
  }
  return RunStore(directory, OpenDatabase(directory / kResultsFile));
}

RunStore RunStore::OpenShards(const std::vector<fs::path>& shards) {
  // all shards have to be of one run
  const RunDescription description = OpenToRead(shards.front()).description();
  for (const fs::path& shard : shards) {
    RefuseDifferentRun(description, OpenToRead(shard).description(), {shard.string()});
  }
  // their rows in one store, which owns the folder that it lies in
  auto folder = std::make_shared<TemporaryFolder>("shards");
  RunStore whole = CreateOrResume(folder->path() / "run", description);
  whole.Gather(shards);
  whole.folder_ = std::move(folder);
  return whole;
}

void RunStore::Gather(const std::vector<fs::path>& shards) {
  for (const fs::path& shard : shards) {
    Guarded(shard / kResultsFile, [&] {
      SQLite::Statement attach(database_, "ATTACH ? AS shard");
      attach.bind(1, (shard / kResultsFile).string());
      attach.exec();
      // the rows of a shard are in as a whole or not at all
      SQLite::Transaction transaction(database_);
      RefuseOverlap(database_, shard);
      for (const char* table : kRowTables) {
        database_.exec(fmt::format("INSERT INTO main.{0} SELECT * FROM shard.{0}", table));
      }
      transaction.commit();
      database_.exec("DETACH shard");
    });
  }
}

std::vector<fs::path> ShardsOf(const fs::path& run) {
  // folders in which a task has put results
  std::vector<fs::path> shards;
  if (!fs::is_directory(run / "shards")) return shards;
  for (const auto& entry : fs::directory_iterator(run / "shards")) {
    if (fs::exists(entry.path() / kResultsFile)) shards.push_back(entry.path());
  }
  std::sort(shards.begin(), shards.end());
  return shards;
}

void NoticeEditedSuite(const RunStore& store) {
  // nobody minds a file that is gone: the database has the suite
  if (!fs::exists(store.suite_file())) return;
  if (ReadWholeFile(store.suite_file()) == store.description().suite_yaml) return;
  SayNotice("notice: {} was edited; the suite that the run stored is taken\n",
            store.suite_file().string());
}

}  // namespace warmjoint
