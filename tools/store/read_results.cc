// Reading results back.
#include <cstring>
#include <limits>
#include <map>
#include <sstream>

#include "tools/store/run_store.h"

namespace warmjoint {
namespace {

using Key = std::pair<int, int>;  // realization, identifier

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
                        "SELECT realization, identifier, discrete, name, truth, estimate,"
                        " estimated, covered, bound FROM parameter"
                        " ORDER BY realization, identifier, discrete, position");
  while (row.executeStep()) {
    ParameterScore score;
    score.name = row.getColumn(3).getString();
    score.truth = Number(row.getColumn(4));
    score.estimate = Number(row.getColumn(5));
    score.estimated = row.getColumn(6).getInt() != 0;
    if (!row.getColumn(7).isNull()) score.covered = row.getColumn(7).getInt() != 0;
    score.bound = Number(row.getColumn(8));
    Score& all = scores[{row.getColumn(0).getInt(), row.getColumn(1).getInt()}];
    (row.getColumn(2).getInt() != 0 ? all.discrete : all.continuous).push_back(std::move(score));
  }
  return scores;
}

std::map<Key, double> ReadSeconds(const SQLite::Database& timings) {
  std::map<Key, double> seconds;
  SQLite::Statement row(timings, "SELECT realization, identifier, seconds FROM identification");
  while (row.executeStep()) {
    seconds[{row.getColumn(0).getInt(), row.getColumn(1).getInt()}] = row.getColumn(2).getDouble();
  }
  return seconds;
}

}  // namespace

std::set<int> RunStore::Finished() const {
  std::set<int> finished;
  SQLite::Statement row(results_, "SELECT realization FROM realization");
  while (row.executeStep()) finished.insert(row.getColumn(0).getInt());
  return finished;
}

std::vector<Result> RunStore::ReadResults() const {
  std::map<Key, Score> scores = ReadParameters(results_);
  const std::map<Key, double> seconds = ReadSeconds(timings_);

  std::vector<Result> all;
  SQLite::Statement row(results_, "SELECT * FROM result ORDER BY realization, identifier");
  while (row.executeStep()) {
    Result result;
    result.realization = row.getColumn("realization");
    result.identifier = row.getColumn("identifier");
    result.status = row.getColumn("status").getString();
    result.message = row.getColumn("message").getString();
    result.metrics = ReadMetrics(row);
    const Key key{result.realization, result.identifier};
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

TraceTable RunStore::ReadTrace(int realization, int identifier) const {
  SQLite::Statement row(
      results_, "SELECT columns, float32 FROM trace WHERE realization = ? AND identifier = ?");
  row.bind(1, realization);
  row.bind(2, identifier);
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
  SQLite::Statement row(timings_, "SELECT seconds FROM simulation ORDER BY realization");
  while (row.executeStep()) seconds.push_back(row.getColumn(0).getDouble());
  return seconds;
}

}  // namespace warmjoint
