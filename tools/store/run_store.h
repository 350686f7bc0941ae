// The results of a run, in SQLite.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <memory>
#include <set>
#include <span>
#include <vector>

#include "tools/store/directory_lock.h"
#include "tools/store/result.h"
#include "tools/store/run_description.h"

namespace warmjoint::inline tools {

/// A run directory: suite.yaml (fully resolved), results.sqlite, and apart from them
/// timings.sqlite, so that results compare bit for bit. A killed process leaves whole realizations.
class RunStore {
 public:
  /// Makes the directory, or opens it to go on. Throws BadInput for a directory that holds
  /// something else, another suite, seed or version (naming what differs), or an older schema.
  static RunStore CreateOrResume(const std::filesystem::path& directory,
                                 const RunDescription& description);

  /// Opens an existing run to read it. Throws BadInput where there is none or its schema is older.
  static RunStore OpenToRead(const std::filesystem::path& directory);

  const std::filesystem::path& directory() const { return directory_; }
  std::string suite_file() const { return directory_ / "suite.yaml"; }

  /// The stored description.
  RunDescription ReadDescription() const;

  /// Adds whole realizations in one transaction.
  void Write(std::span<const Realization> realizations);

  /// What is in.
  std::set<Unit> Finished() const;

  /// All results ordered by (variant, realization, identifier), without their traces.
  std::vector<Result> ReadResults() const;

  /// The trace of one result; empty where there is none.
  TraceTable ReadTrace(Unit unit, int identifier) const;

  /// Wall time of the plant for each unit in order, s.
  std::vector<double> ReadSimulationSeconds() const;

 private:
  RunStore(std::filesystem::path directory, int open_flags);

  std::filesystem::path directory_;
  std::unique_ptr<DirectoryLock> lock_;  // of a writer
  SQLite::Database results_;
  SQLite::Database timings_;
};

}  // namespace warmjoint::inline tools
