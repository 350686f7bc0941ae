// The results of a run, in SQLite.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "scenarios/suite.h"
#include "tools/store/folders.h"
#include "tools/store/result.h"
#include "tools/store/run_description.h"

namespace warmjoint {

/// How many results of one identifier have one status.
struct StatusCount {
  int identifier = 0;  // position in the suite's list
  std::string status;
  std::size_t results = 0;
};

/// A run directory: results.sqlite, and suite.yaml (fully resolved, a copy for people). A killed process
/// leaves whole realizations. A database that someone edited is not noticed; one that is damaged is
/// refused by what SQLite says of it.
class RunStore {
 public:
  /// Makes the directory, or opens it to go on. Throws BadInput for a directory that holds
  /// something else, another suite, seed or version (naming what differs), or another schema.
  static RunStore CreateOrResume(const std::filesystem::path& directory,
                                 const RunDescription& description);

  /// Opens an existing run to read it, which needs no right to write. Of one that was planned as shards
  /// and is not merged yet, it takes what the shards hold so far. Throws BadInput where there is
  /// none, its schema is another, it is damaged, or it holds results that its suite has no place for.
  static RunStore OpenToRead(const std::filesystem::path& directory);

  const std::filesystem::path& directory() const { return directory_; }
  std::filesystem::path results_file() const;
  std::filesystem::path suite_file() const { return directory_ / "suite.yaml"; }

  const RunDescription& description() const { return description_; }
  /// The suite as the store holds it; RUN/suite.yaml is a copy, which people may edit.
  const Suite& suite() const { return suite_; }

  /// Adds whole realizations in one transaction. Throws OutputFailed where there is no room.
  void Write(std::span<const Realization> realizations);

  /// Adds all that other stores of the same run hold. Throws BadInput for a realization that is here
  /// already.
  void Gather(const std::vector<std::filesystem::path>& shards);

  /// What is in.
  std::set<RunUnit> Finished() const;

  /// In the order of identifiers.
  std::vector<StatusCount> CountStatuses() const;

  /// Calls work(result) for each result in the order of (variant, realization, identifier), without its
  /// trace. Memory does not grow with the run.
  void ForEachResult(const std::function<void(Result)>& work) const;

  /// The trace of one result; empty where there is none.
  TraceTable ReadTrace(RunUnit unit, int identifier) const;

  /// For questions of others; see database.cc for its tables.
  const SQLite::Database& database() const { return database_; }

 private:
  RunStore(std::filesystem::path directory, SQLite::Database database);
  static RunStore OpenShards(const std::vector<std::filesystem::path>& shards);

  std::shared_ptr<TemporaryFolder> folder_;  // of shards that were put together to read them
  std::filesystem::path directory_;
  std::unique_ptr<DirectoryLock> lock_;  // of a writer
  SQLite::Database database_;
  RunDescription description_;
  Suite suite_;
};

/// The folders in RUN/shards that hold results, by name; none where RUN was not planned as shards.
std::vector<std::filesystem::path> ShardsOf(const std::filesystem::path& run);

/// Says on stderr where RUN/suite.yaml is not the stored suite any more.
void NoticeEditedSuite(const RunStore& store);

}  // namespace warmjoint
