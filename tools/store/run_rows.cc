// Whole realizations on their way into a run's database and out of it.
#include <SQLiteCpp/VariadicBind.h>
#include <fmt/format.h>

#include <cstring>
#include <sstream>

#include "tools/store/database.h"
#include "tools/store/run_store.h"

namespace warmjoint {
namespace {

/// The columns of a result from its metrics on.
constexpr const char* kColumns =
    "n, parameters, effective_parameters, rmse, mae, fit, fpe, npe_continuous, npe_discrete, "
    "bound_npe_continuous, bound_npe_discrete";

/// Binds values to the places from `first` on. SQLite stores NaN as NULL.
template <typename... Values>
void BindFrom(SQLite::Statement& statement, int first, const Values&... values) {
  (statement.bind(first++, values), ...);
}

/// The statements of one batch.
struct Inserts {
  explicit Inserts(SQLite::Database& db)
      : realization(db, "INSERT INTO realization VALUES (?, ?, ?)"),
        result(db, "INSERT INTO result VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"),
        parameter(db, "INSERT INTO parameter VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"),
        measure(db, "INSERT INTO measure VALUES (?, ?, ?, ?, ?, ?)"),
        trace(db, "INSERT INTO trace VALUES (?, ?, ?, ?, ?)") {}

  SQLite::Statement realization, result, parameter, measure, trace;
};

/// What is not bound stays NULL.
SQLite::Statement& Anew(SQLite::Statement& statement) {
  statement.reset();
  statement.clearBindings();
  return statement;
}

void InsertParameters(SQLite::Statement& insert, const Result& result, int discrete,
                      const std::vector<ParameterScore>& scores) {
  for (size_t i = 0; i < scores.size(); ++i) {
    const ParameterScore& score = scores[i];
    BindFrom(Anew(insert), 1, result.variant, result.realization, result.identifier, discrete,
             static_cast<int>(i), score.name, score.truth, score.estimate, score.estimated ? 1 : 0);
    if (score.covered) insert.bind(10, *score.covered ? 1 : 0);
    insert.bind(11, score.bound);
    insert.exec();
  }
}

void InsertResult(Inserts& inserts, const Result& result) {
  // an answer without figures or score stays without
  BindFrom(Anew(inserts.result), 1, result.variant, result.realization, result.identifier,
           result.status, result.message, result.seconds);
  if (const auto& m = result.metrics) {
    BindFrom(inserts.result, 7, m->n, m->parameters, m->effective_parameters, m->rmse, m->mae,
             m->fit, m->fpe);
  }
  if (const auto& s = result.score) {
    BindFrom(inserts.result, 14, s->npe_continuous, s->npe_discrete, s->bound_npe_continuous,
             s->bound_npe_discrete);
    InsertParameters(inserts.parameter, result, 0, s->continuous);
    InsertParameters(inserts.parameter, result, 1, s->discrete);
  }
  inserts.result.exec();
  int position = 0;
  for (const auto& [name, value] : result.measures) {
    BindFrom(Anew(inserts.measure), 1, result.variant, result.realization, result.identifier,
             position++, name, value);
    inserts.measure.exec();
  }

  // how the identifier came to its answer, where it iterates
  if (result.trace.values.empty()) return;
  BindFrom(Anew(inserts.trace), 1, result.variant, result.realization, result.identifier,
           fmt::format("{}", fmt::join(result.trace.columns, ",")));
  inserts.trace.bind(5, result.trace.values.data(),
                     static_cast<int>(result.trace.values.size() * sizeof(float)));
  inserts.trace.exec();
}

std::optional<Metrics> ReadMetrics(SQLite::Statement& row) {
  // n is there where a fit has figures
  if (row.getColumn(6).isNull()) return std::nullopt;
  Metrics metrics;
  metrics.n = row.getColumn(6);
  metrics.parameters = row.getColumn(7);
  metrics.effective_parameters = NumberIn(row.getColumn(8));
  metrics.rmse = NumberIn(row.getColumn(9));
  metrics.mae = NumberIn(row.getColumn(10));
  metrics.fit = NumberIn(row.getColumn(11));
  metrics.fpe = NumberIn(row.getColumn(12));
  return metrics;
}

/// Errors of parameters make a score; without any there is none.
void ReadScore(SQLite::Statement& row, SQLite::Statement& parameters, Result& result) {
  parameters.reset();
  BindFrom(parameters, 1, result.variant, result.realization, result.identifier);
  while (parameters.executeStep()) {
    if (!result.score) result.score.emplace();
    ParameterScore score;
    score.name = parameters.getColumn(1).getString();
    score.truth = NumberIn(parameters.getColumn(2));
    score.estimate = NumberIn(parameters.getColumn(3));
    score.estimated = parameters.getColumn(4).getInt() != 0;
    if (!parameters.getColumn(5).isNull()) score.covered = parameters.getColumn(5).getInt() != 0;
    score.bound = NumberIn(parameters.getColumn(6));
    const bool discrete = parameters.getColumn(0).getInt() != 0;
    (discrete ? result.score->discrete : result.score->continuous).push_back(std::move(score));
  }
  if (!result.score) return;
  result.score->npe_continuous = NumberIn(row.getColumn(13));
  result.score->npe_discrete = NumberIn(row.getColumn(14));
  result.score->bound_npe_continuous = NumberIn(row.getColumn(15));
  result.score->bound_npe_discrete = NumberIn(row.getColumn(16));
}

/// What a compensator reached.
void ReadMeasures(SQLite::Statement& measures, Result& result) {
  measures.reset();
  BindFrom(measures, 1, result.variant, result.realization, result.identifier);
  while (measures.executeStep()) {
    result.measures.emplace_back(measures.getColumn(0).getString(),
                                 NumberIn(measures.getColumn(1)));
  }
}

}  // namespace

void RunStore::Write(std::span<const Realization> realizations) {
  Guarded(results_file(), [&] {
    // a batch is stored as a whole or not at all
    SQLite::Transaction transaction(database_);
    Inserts inserts(database_);
    for (const Realization& one : realizations) {
      BindFrom(Anew(inserts.realization), 1, one.unit.variant, one.unit.realization,
               one.simulation_seconds);
      inserts.realization.exec();
      for (const Result& result : one.results) InsertResult(inserts, result);
    }
    transaction.commit();
  });
}

std::set<RunUnit> RunStore::Finished() const {
  return Guarded(results_file(), [&] {
    std::set<RunUnit> finished;
    SQLite::Statement row(
        database_, "SELECT variant, realization FROM realization ORDER BY variant, realization");
    while (row.executeStep()) {
      finished.insert(finished.end(), {row.getColumn(0).getInt(), row.getColumn(1).getInt()});
    }
    return finished;
  });
}

std::vector<StatusCount> RunStore::CountStatuses() const {
  return Guarded(results_file(), [&] {
    std::vector<StatusCount> counts;
    SQLite::Statement row(database_,
                          "SELECT identifier, status, count(*) FROM result GROUP BY identifier, "
                          "status ORDER BY identifier, status");
    while (row.executeStep()) {
      counts.push_back({row.getColumn(0).getInt(), row.getColumn(1).getString(),
                        static_cast<std::size_t>(row.getColumn(2).getInt64())});
    }
    return counts;
  });
}

void RunStore::ForEachResult(const std::function<void(Result)>& work) const {
  Guarded(results_file(), [&] {
    SQLite::Statement row(
        database_, fmt::format("SELECT variant, realization, identifier, status, message, seconds, "
                               "{} FROM result ORDER BY variant, realization, identifier",
                               kColumns));
    SQLite::Statement parameters(
        database_,
        "SELECT discrete, name, truth, estimate, estimated, covered, bound FROM parameter WHERE "
        "variant = ? AND realization = ? AND identifier = ? ORDER BY discrete, position");
    SQLite::Statement measures(
        database_,
        "SELECT name, value FROM measure WHERE variant = ? AND realization = ? AND identifier = ? "
        "ORDER BY position");
    while (row.executeStep()) {
      Result result;
      result.variant = row.getColumn(0).getInt();
      result.realization = row.getColumn(1).getInt();
      result.identifier = row.getColumn(2).getInt();
      result.status = row.getColumn(3).getString();
      result.message = row.getColumn(4).getString();
      result.seconds = NumberIn(row.getColumn(5));
      result.metrics = ReadMetrics(row);
      ReadScore(row, parameters, result);
      ReadMeasures(measures, result);
      work(std::move(result));
    }
  });
}

TraceTable RunStore::ReadTrace(RunUnit unit, int identifier) const {
  return Guarded(results_file(), [&] {
    SQLite::Statement row(database_,
                          "SELECT columns, float32 FROM trace WHERE variant = ? AND realization = "
                          "? AND identifier = ?");
    BindFrom(row, 1, unit.variant, unit.realization, identifier);
    TraceTable trace;
    if (!row.executeStep()) return trace;
    // names of the columns, then all numbers in one piece
    std::istringstream columns(row.getColumn(0).getString());
    for (std::string name; std::getline(columns, name, ',');) trace.columns.push_back(name);
    const SQLite::Column blob = row.getColumn(1);
    trace.values.resize(static_cast<size_t>(blob.getBytes()) / sizeof(float));
    if (trace.rows() * trace.columns.size() != trace.values.size()) {
      Refuse({results_file().string()},
             "holds a trace of realization {} whose numbers do not fill its {} columns; run the "
             "suite anew in another directory",
             unit.realization, trace.columns.size());
    }
    if (!trace.values.empty()) {
      std::memcpy(trace.values.data(), blob.getBlob(), trace.values.size() * sizeof(float));
    }
    return trace;
  });
}

}  // namespace warmjoint
