// Reading results back.
#include <algorithm>
#include <cstring>
#include <limits>
#include <sstream>

#include "tools/store/digest.h"
#include "tools/store/open_database.h"
#include "tools/store/run_store.h"

namespace warmjoint::inline tools {
namespace {

using Key = std::pair<Unit, int>;  // and position of the identifier

/// The key in the first three columns.
Key KeyOf(SQLite::Statement& row) {
  return {{row.getColumn(0).getInt(), row.getColumn(1).getInt()}, row.getColumn(2).getInt()};
}

/// A stored number; NULL stands for NaN.
double Number(const SQLite::Column& column) {
  return column.isNull() ? std::numeric_limits<double>::quiet_NaN() : column.getDouble();
}

std::optional<Metrics> ReadMetrics(SQLite::Statement& row) {
  if (row.getColumn("n").isNull()) return std::nullopt;
  Metrics metrics;
  metrics.n = row.getColumn("n");
  metrics.parameters = row.getColumn("parameters");
  metrics.effective_parameters = Number(row.getColumn("effective_parameters"));
  metrics.rmse = Number(row.getColumn("rmse"));
  metrics.mae = Number(row.getColumn("mae"));
  metrics.fit = Number(row.getColumn("fit"));
  metrics.fpe = Number(row.getColumn("fpe"));
  return metrics;
}

std::map<Key, Score> ReadParameters(const SQLite::Database& results) {
  std::map<Key, Score> scores;
  SQLite::Statement row(results,
                        "SELECT variant, realization, identifier, discrete, name, truth, estimate,"
                        " estimated, covered, bound FROM parameter"
                        " ORDER BY variant, realization, identifier, discrete, position");
  while (row.executeStep()) {
    ParameterScore score;
    score.name = row.getColumn(4).getString();
    score.truth = Number(row.getColumn(5));
    score.estimate = Number(row.getColumn(6));
    score.estimated = row.getColumn(7).getInt() != 0;
    if (!row.getColumn(8).isNull()) score.covered = row.getColumn(8).getInt() != 0;
    score.bound = Number(row.getColumn(9));
    Score& all = scores[KeyOf(row)];
    (row.getColumn(3).getInt() != 0 ? all.discrete : all.continuous).push_back(std::move(score));
  }
  return scores;
}

std::map<Key, double> ReadSeconds(const SQLite::Database& timings) {
  std::map<Key, double> seconds;
  SQLite::Statement row(timings,
                        "SELECT variant, realization, identifier, seconds FROM identification");
  while (row.executeStep()) {
    seconds[KeyOf(row)] = Number(row.getColumn(3));
  }
  return seconds;
}

/// Digests of the finished units, as they were stored with them.
std::map<Unit, std::string> ReadDigests(const SQLite::Database& results) {
  std::map<Unit, std::string> digests;
  SQLite::Statement row(results, "SELECT variant, realization, digest FROM realization");
  while (row.executeStep()) {
    digests[{row.getColumn(0).getInt(), row.getColumn(1).getInt()}] = row.getColumn(2).getString();
  }
  return digests;
}

[[noreturn]] void RefuseChanged(Unit unit, const Place& place) {
  Refuse(place,
         "variant {}, realization {} is not what the run stored (its digest differs): the file was "
         "changed or is damaged. Run the suite anew in another directory",
         unit.variant, unit.realization);
}

/// Refuses units whose results do not have the digest that was stored with them. results: ordered
/// by unit and identifier.
void CheckDigests(std::map<Unit, std::string> digests, const std::string& plan,
                  std::span<const Result> results, const Place& place) {
  for (auto begin = results.begin(); begin != results.end();) {
    const Unit unit{begin->variant, begin->realization};
    const auto end = std::find_if(begin, results.end(), [&](const Result& result) {
      return Unit{result.variant, result.realization} != unit;
    });
    if (DigestOfResults(plan, unit, {begin, end}) != digests[unit]) RefuseChanged(unit, place);
    digests.erase(unit);
    begin = end;
  }
  // a unit whose results were all removed
  if (!digests.empty()) RefuseChanged(digests.begin()->first, place);
}

}  // namespace

std::set<Unit> RunStore::Finished() const {
  std::set<Unit> finished;
  SQLite::Statement row(results_, "SELECT variant, realization FROM realization");
  while (row.executeStep()) {
    finished.insert({row.getColumn(0).getInt(), row.getColumn(1).getInt()});
  }
  return finished;
}

std::vector<Result> RunStore::ReadResults() const {
  return Guarded(results_file(), [&] {
    std::vector<Result> all = ReadRows();
    CheckDigests(ReadDigests(results_), DigestOfPlan(ReadDescription()), all,
                 {results_file().string()});
    return all;
  });
}

std::vector<Result> RunStore::ReadRows() const {
  std::map<Key, Score> scores = ReadParameters(results_);
  const std::map<Key, double> seconds = timings_ ? ReadSeconds(*timings_) : std::map<Key, double>();

  std::vector<Result> all;
  SQLite::Statement row(results_, "SELECT * FROM result ORDER BY variant, realization, identifier");
  while (row.executeStep()) {
    Result result;
    const Key key = KeyOf(row);
    result.variant = key.first.variant;
    result.realization = key.first.realization;
    result.identifier = key.second;
    result.status = row.getColumn("status").getString();
    result.message = row.getColumn("message").getString();
    result.metrics = ReadMetrics(row);
    if (const auto found = scores.find(key); found != scores.end()) {
      result.score = std::move(found->second);
      result.score->npe_continuous = Number(row.getColumn("npe_continuous"));
      result.score->npe_discrete = Number(row.getColumn("npe_discrete"));
      result.score->bound_npe_continuous = Number(row.getColumn("bound_npe_continuous"));
      result.score->bound_npe_discrete = Number(row.getColumn("bound_npe_discrete"));
    }
    const auto time = seconds.find(key);
    result.seconds =
        time == seconds.end() ? std::numeric_limits<double>::quiet_NaN() : time->second;
    all.push_back(std::move(result));
  }
  return all;
}

TraceTable RunStore::ReadTrace(Unit unit, int identifier) const {
  return Guarded(results_file(), [&] {
    SQLite::Statement row(results_,
                          "SELECT columns, float32, digest FROM trace"
                          " WHERE variant = ? AND realization = ? AND identifier = ?");
    row.bind(1, unit.variant);
    row.bind(2, unit.realization);
    row.bind(3, identifier);
    TraceTable trace;
    if (!row.executeStep()) return trace;

    std::istringstream columns(row.getColumn(0).getString());
    for (std::string name; std::getline(columns, name, ',');) trace.columns.push_back(name);
    const SQLite::Column blob = row.getColumn(1);
    trace.values.resize(static_cast<size_t>(blob.getBytes()) / sizeof(float));
    if (!trace.values.empty()) {
      std::memcpy(trace.values.data(), blob.getBlob(), trace.values.size() * sizeof(float));
    }
    const std::string digest =
        DigestOfTrace(DigestOfPlan(ReadDescription()), unit, identifier, trace);
    if (digest != row.getColumn(2).getString()) RefuseChanged(unit, {results_file().string()});
    return trace;
  });
}

std::map<Unit, double> RunStore::ReadSimulationSeconds() const {
  std::map<Unit, double> seconds;
  if (!timings_) return seconds;
  return Guarded(timings_file(), [&] {
    SQLite::Statement row(*timings_, "SELECT variant, realization, seconds FROM simulation");
    while (row.executeStep()) {
      seconds[{row.getColumn(0).getInt(), row.getColumn(1).getInt()}] = Number(row.getColumn(2));
    }
    return seconds;
  });
}

}  // namespace warmjoint::inline tools
