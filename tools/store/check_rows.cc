#include "tools/store/check_rows.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <limits>

#include "models/foundation/parse_number.h"

namespace warmjoint::inline tools {
namespace {

/// Realizations of each variant, by the suite; as many as there are numbers for where it is silent.
std::int64_t RealizationsOf(const RunDescription& description) {
  constexpr std::int64_t most = std::numeric_limits<int>::max();
  try {
    const YAML::Node value = YAML::Load(description.suite_yaml)["realizations"];
    if (value && value.IsScalar()) return ParseInteger(value.Scalar()).value_or(most);
  } catch (const YAML::Exception&) {
    // whoever needs the suite itself refuses it with what is wrong
  }
  return most;
}

/// Refuses the first row that `query` finds: variant, realization, and in words what is wrong.
void RefuseFound(const SQLite::Database& results, const std::string& query, const char* wrong,
                 const Place& place) {
  SQLite::Statement row(results, query + " LIMIT 1");
  if (!row.executeStep()) return;
  Refuse(
      place,
      "variant {}, realization {}: {}; the file was changed after the run. Run the suite anew in "
      "another directory",
      row.getColumn(0).getInt64(), row.getColumn(1).getInt64(), wrong);
}

void CheckPositions(const SQLite::Database& results, const char* table, const Place& place) {
  // positions from 0 on, without a hole
  SQLite::Statement row(results, fmt::format("SELECT count(*), coalesce(min(position), 0),"
                                             " coalesce(max(position), -1) FROM {}",
                                             table));
  row.executeStep();
  const std::int64_t count = row.getColumn(0).getInt64();
  if (row.getColumn(1).getInt64() == 0 && row.getColumn(2).getInt64() == count - 1) return;
  Refuse(place, "the positions in its table {} have gaps; the file was changed after the run",
         table);
}

}  // namespace

void CheckRows(const SQLite::Database& results, const RunDescription& description,
               const Place& place) {
  CheckPositions(results, "identifier", place);
  CheckPositions(results, "variant", place);

  // an index into each table that the run has, and a unit that is finished
  const std::size_t variants = std::max<std::size_t>(1, description.variants.size());
  // rows that name units or identifiers that the run does not have, or units that are not finished
  const std::string unit = fmt::format(
      "SELECT variant, realization FROM {{}} WHERE NOT (variant >= 0 AND variant < {} AND"
      " realization >= 0 AND realization < {})",
      variants, RealizationsOf(description));
  const std::string identifier = fmt::format(
      "SELECT variant, realization FROM {{}} WHERE NOT (identifier >= 0 AND identifier < {})",
      description.identifiers.size());
  const std::string orphan =
      "SELECT variant, realization FROM {0} WHERE NOT EXISTS (SELECT 1 FROM realization AS r WHERE"
      " r.variant = {0}.variant AND r.realization = {0}.realization)";

  // every table that has such rows
  RefuseFound(results, fmt::format(fmt::runtime(unit), "realization"), "the run has none", place);
  for (const char* table : {"result", "parameter", "trace"}) {
    RefuseFound(results, fmt::format(fmt::runtime(unit), table), "the run has none", place);
    RefuseFound(results, fmt::format(fmt::runtime(identifier), table),
                "names an identifier that the run does not have", place);
    RefuseFound(results, fmt::format(fmt::runtime(orphan), table),
                "has rows without being marked as finished", place);
  }
}

}  // namespace warmjoint::inline tools
