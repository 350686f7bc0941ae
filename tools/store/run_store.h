// The results of a run, in SQLite.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>
#include <warmjoint/estimate.h>
#include <warmjoint/score.h>

#include <compare>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "models/foundation/bad_input.h"
#include "scenarios/suite.h"
#include "tools/store/folders.h"

namespace warmjoint {

/// Two runs with equal descriptions have equal results on one kind of machine.
struct RunDescription {
  std::string suite_yaml;  // fully resolved: realizations, seed and identifiers included
  std::vector<std::pair<std::string, std::string>> versions;  // of all that computes, by name
};

/// Throws BadInput from `place`, naming what differs, when the two do not give the same results.
void RefuseDifferentRun(const RunDescription& stored, const RunDescription& asked,
                        const Place& place);

/// The trace of an iterative identifier, for pictures: single precision, one row an iteration.
struct TraceTable {
  std::vector<std::string> columns;  // iteration, rmse, npe_continuous, npe_discrete, parameters
  std::vector<float> values;         // [rows x columns], row after row; NaN where unknown

  size_t rows() const { return columns.empty() ? 0 : values.size() / columns.size(); }
};

/// What one identifier made of one realization.
struct Result {
  int variant = 0;  // position in the suite's ladder; 0 without one
  int realization = 0;
  int identifier = 0;   // position in the suite's list
  std::string status;   // a StatusName, or how the identifier failed to answer
  std::string message;  // one sentence
  std::optional<Metrics> metrics;
  std::optional<Score> score;  // where there are numbers to score
  /// Of a compensator (kCompensationMeasures), in their order; NaN where there is none.
  std::vector<std::pair<std::string, double>> measures;
  TraceTable trace;    // of an identifier that iterates; of a compensator its residual by minute
  double seconds = 0;  // wall time of the identification
};

/// One realization of one variant of a suite: the unit of work.
struct RunUnit {
  int variant = 0;      // position in the suite's ladder; 0 without one
  int realization = 0;  // from 0

  auto operator<=>(const RunUnit&) const = default;
};

/// A finished unit: it enters the store as a whole or not at all.
struct Realization {
  RunUnit unit;
  double simulation_seconds = 0;  // wall time of the plant
  std::vector<Result> results;    // one for each identifier of the suite, in its order
};

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
