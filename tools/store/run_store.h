// The results of a run, in SQLite.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "tools/store/copy_rows.h"
#include "tools/store/directory_lock.h"
#include "tools/store/open_database.h"
#include "tools/store/result.h"
#include "tools/store/run_description.h"
#include "tools/store/temporary_folder.h"

namespace warmjoint::inline tools {

/// A run directory: suite.yaml (fully resolved, a copy for people), results.sqlite, and apart from
/// them timings.sqlite, so that results compare bit for bit. A killed process leaves whole
/// realizations. A store may have been changed by others: what is read is checked against its
/// schema, the run's lists and the digests that were stored with it.
class RunStore {
 public:
  /// Makes the directory, or opens it to go on. Throws BadInput for a directory that holds
  /// something else, another suite, seed or version (naming what differs), or an older schema.
  static RunStore CreateOrResume(const std::filesystem::path& directory,
                                 const RunDescription& description);

  /// Opens an existing run to read it, which needs no right to write. Of one that was planned as shards
  /// and is not merged yet, it takes what the shards hold so far. Throws BadInput where there is
  /// none, its schema is older, or it was changed so that its rows do not fit the run.
  static RunStore OpenToRead(const std::filesystem::path& directory, Access access = Access::read);

  const std::filesystem::path& directory() const { return directory_; }
  std::string suite_file() const { return directory_ / "suite.yaml"; }

  std::filesystem::path results_file() const;
  std::filesystem::path timings_file() const;

  /// The stored description.
  RunDescription ReadDescription() const;

  /// Adds whole realizations in one transaction. Throws OutputFailed where there is no room.
  void Write(std::span<const Realization> realizations);

  /// Writes results.sqlite anew in the order of its keys: whatever order the results came in, and
  /// however often the run was stopped, equal results are then equal bytes.
  void Settle();

  /// Takes the results and wall times of run directories, in the order of their keys, in place of what
  /// is there. Nobody may write to them meanwhile.
  void Gather(const std::vector<std::filesystem::path>& shards, Overlap overlap);

  /// What is in.
  std::set<Unit> Finished() const;
  /// Calls work(unit) for the same in ascending order.
  void ForEachFinished(const std::function<void(Unit)>& work) const;

  /// How many results have each status; as they stand there, unchecked.
  std::map<std::string, int> CountStatuses() const;

  /// Calls work(results) for each unit in the order of (variant, realization): its results in the order
  /// of identifiers, without their traces. Memory does not grow with the run. Throws BadInput for a
  /// realization that is not what was stored.
  void ForEachUnit(const std::function<void(std::vector<Result>)>& work) const;

  /// All results ordered by (variant, realization, identifier), without their traces. Throws
  /// BadInput for a realization that is not what was stored.
  std::vector<Result> ReadResults() const;

  /// Throws BadInput for a realization or a trace that is not what was stored.
  void Verify() const;

  /// The trace of one result; empty where there is none.
  TraceTable ReadTrace(Unit unit, int identifier) const;

  /// Wall time of the plant for each unit, s; NaN where unknown.
  std::map<Unit, double> ReadSimulationSeconds() const;

 private:
  RunStore(std::filesystem::path directory, Access access);
  static RunStore OpenShards(const std::vector<std::filesystem::path>& shards);

  void WriteAnew(const std::vector<RowSource>& sources, Overlap overlap);

  std::shared_ptr<TemporaryFolder> folder_;  // of shards that were put together to read them
  std::filesystem::path directory_;
  std::unique_ptr<DirectoryLock> lock_;  // of a writer
  SQLite::Database results_;
  std::optional<SQLite::Database> timings_;  // of a run to read, nothing where they are lost
  std::string plan_;                         // digest of the description
};

}  // namespace warmjoint::inline tools
