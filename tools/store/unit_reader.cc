#include "tools/store/unit_reader.h"

#include <limits>
#include <tuple>
#include <utility>

#include "tools/store/digest.h"

namespace warmjoint::inline tools {
namespace {

constexpr const char* kRealizations =
    "SELECT variant, realization, digest FROM realization ORDER BY variant, realization";
constexpr const char* kResults =
    "SELECT variant, realization, identifier, status, message, n, parameters,"
    " effective_parameters, rmse, mae, fit, fpe, npe_continuous, npe_discrete,"
    " bound_npe_continuous, bound_npe_discrete FROM result"
    " ORDER BY variant, realization, identifier";
constexpr const char* kParameters =
    "SELECT variant, realization, identifier, discrete, name, truth, estimate, estimated, covered,"
    " bound FROM parameter ORDER BY variant, realization, identifier, discrete, position";
constexpr const char* kSeconds =
    "SELECT variant, realization, identifier, seconds FROM identification"
    " ORDER BY variant, realization, identifier";

std::optional<Metrics> ReadMetrics(SQLite::Statement& row) {
  // n is there where a fit has figures
  if (row.getColumn(5).isNull()) return std::nullopt;
  Metrics metrics;
  metrics.n = row.getColumn(5);
  metrics.parameters = row.getColumn(6);
  metrics.effective_parameters = StoredNumber(row.getColumn(7));
  metrics.rmse = StoredNumber(row.getColumn(8));
  metrics.mae = StoredNumber(row.getColumn(9));
  metrics.fit = StoredNumber(row.getColumn(10));
  metrics.fpe = StoredNumber(row.getColumn(11));
  return metrics;
}

ParameterScore ReadParameter(SQLite::Statement& row) {
  ParameterScore score;
  score.name = row.getColumn(4).getString();
  score.truth = StoredNumber(row.getColumn(5));
  score.estimate = StoredNumber(row.getColumn(6));
  score.estimated = row.getColumn(7).getInt() != 0;
  if (!row.getColumn(8).isNull()) score.covered = row.getColumn(8).getInt() != 0;
  score.bound = StoredNumber(row.getColumn(9));
  return score;
}

}  // namespace

double StoredNumber(const SQLite::Column& column) {
  return column.isNull() ? std::numeric_limits<double>::quiet_NaN() : column.getDouble();
}

void RefuseChangedUnit(Unit unit, const Place& place) {
  Refuse(place,
         "variant {}, realization {} is not what the run stored (its digest differs): the file was "
         "changed or is damaged. Run the suite anew in another directory",
         unit.variant, unit.realization);
}

UnitReader::Rows::Rows(const SQLite::Database& database, const char* query) : row(database, query) {
  Step();
}

Unit UnitReader::Rows::unit() { return {row.getColumn(0).getInt(), row.getColumn(1).getInt()}; }

UnitReader::UnitReader(const SQLite::Database& results, const SQLite::Database* timings,
                       std::string plan, Place place)
    : plan_(std::move(plan)),
      place_(std::move(place)),
      realizations_(results, kRealizations),
      results_(results, kResults),
      parameters_(results, kParameters) {
  if (timings) seconds_.emplace(*timings, kSeconds);
}

std::optional<std::vector<Result>> UnitReader::Next() {
  // the next finished unit, with the digest of what it had
  if (!realizations_.open) return std::nullopt;
  const Unit unit = realizations_.unit();
  const std::string digest = realizations_.row.getColumn(2).getString();
  realizations_.Step();

  // the results of all identifiers, which the digest covers
  std::vector<Result> all;
  while (results_.open && results_.unit() == unit) {
    all.push_back(ReadResult());
    results_.Step();
  }
  if (DigestOfResults(plan_, unit, all) != digest) RefuseChangedUnit(unit, place_);
  return all;
}

Result UnitReader::ReadResult() {
  SQLite::Statement& row = results_.row;
  Result result;
  result.variant = row.getColumn(0).getInt();
  result.realization = row.getColumn(1).getInt();
  result.identifier = row.getColumn(2).getInt();
  result.status = row.getColumn(3).getString();
  result.message = row.getColumn(4).getString();
  result.metrics = ReadMetrics(row);

  // errors of parameters make a score; without any there is none
  ReadParameters(result);
  if (result.score) {
    result.score->npe_continuous = StoredNumber(row.getColumn(12));
    result.score->npe_discrete = StoredNumber(row.getColumn(13));
    result.score->bound_npe_continuous = StoredNumber(row.getColumn(14));
    result.score->bound_npe_discrete = StoredNumber(row.getColumn(15));
  }
  result.seconds = ReadSeconds(result);
  return result;
}

void UnitReader::ReadParameters(Result& result) {
  // both tables are read once, in the same order
  const std::tuple key{Unit{result.variant, result.realization}, result.identifier};
  Rows& rows = parameters_;
  for (; rows.open; rows.Step()) {
    const std::tuple here{rows.unit(), rows.identifier()};
    if (here > key) return;
    // rows before are of results that are gone, which the unit's digest tells
    if (here < key) continue;
    if (!result.score) result.score.emplace();
    const bool discrete = rows.row.getColumn(3).getInt() != 0;
    (discrete ? result.score->discrete : result.score->continuous)
        .push_back(ReadParameter(rows.row));
  }
}

double UnitReader::ReadSeconds(const Result& result) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  if (!seconds_) return unknown;
  const std::tuple key{Unit{result.variant, result.realization}, result.identifier};
  Rows& rows = *seconds_;
  // times of other results are passed over; one that is missing is not known
  while (rows.open && std::tuple{rows.unit(), rows.identifier()} < key) rows.Step();
  const bool known = rows.open && std::tuple{rows.unit(), rows.identifier()} == key;
  return known ? StoredNumber(rows.row.getColumn(3)) : unknown;
}

}  // namespace warmjoint::inline tools
