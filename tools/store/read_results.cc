// Reading results back.
#include <cstring>
#include <limits>
#include <map>
#include <sstream>

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
  std::map<Key, Score> scores = ReadParameters(results_);
  const std::map<Key, double> seconds = ReadSeconds(timings_);

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
  SQLite::Statement row(results_,
                        "SELECT columns, float32 FROM trace"
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
  std::memcpy(trace.values.data(), blob.getBlob(), trace.values.size() * sizeof(float));
  return trace;
}

std::vector<double> RunStore::ReadSimulationSeconds() const {
  std::vector<double> seconds;
  SQLite::Statement row(timings_, "SELECT seconds FROM simulation ORDER BY variant, realization");
  while (row.executeStep()) seconds.push_back(row.getColumn(0).getDouble());
  return seconds;
}

}  // namespace warmjoint::inline tools
