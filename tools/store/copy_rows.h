// Rows of several stores, put together in the order of their keys.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <vector>

#include "tools/store/result.h"

namespace warmjoint::inline tools {

/// A database file with rows of a run.
struct RowSource {
  std::filesystem::path file;
  /// For each variant that it holds, in order, the first realization of it. A source is opened when its
  /// turn comes and closed after it: of shards that lie one after the other, one is open at a time.
  std::vector<Unit> first;
};

/// The source that the results in `file` are. Nobody may write to it as long as it is used.
RowSource SourceOf(const std::filesystem::path& file);

/// What is done with a realization that several sources hold.
enum class Overlap {
  refused,
  equal,  // copied once; refused where the digests differ
};

/// Copies all rows of the results of `sources` into empty tables, in the order of their keys, so that
/// equal results are equal bytes in whatever order they came. Time grows with the number of rows.
/// Throws BadInput for an overlap that is not allowed.
void CopyResults(SQLite::Database& fresh, const std::vector<RowSource>& sources, Overlap overlap);

/// The same for the wall times, of which the first is taken.
void CopyTimings(SQLite::Database& fresh, const std::vector<RowSource>& sources);

}  // namespace warmjoint::inline tools
