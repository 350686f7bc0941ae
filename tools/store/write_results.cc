// Writing whole realizations.
#include <fmt/format.h>

#include "tools/store/digest.h"
#include "tools/store/open_database.h"
#include "tools/store/run_store.h"

namespace warmjoint::inline tools {
namespace {

/// Binds the arguments from position 1 on and runs the statement once. NaN is stored as NULL.
template <typename... Args>
void Insert(SQLite::Statement& statement, const Args&... values) {
  statement.reset();
  int position = 0;
  (statement.bind(++position, values), ...);
  statement.exec();
}

/// The statements of one batch.
struct Inserts {
  explicit Inserts(SQLite::Database& db)
      : realization(db, "INSERT INTO realization VALUES (?, ?, ?)"),
        failure(db,
                "INSERT INTO result(variant, realization, identifier, status, message)"
                " VALUES (?, ?, ?, ?, ?)"),
        metrics(db,
                "UPDATE result SET n=?4, parameters=?5, effective_parameters=?6, rmse=?7, mae=?8,"
                " fit=?9, fpe=?10 WHERE variant=?1 AND realization=?2 AND identifier=?3"),
        score(db,
              "UPDATE result SET npe_continuous=?4, npe_discrete=?5, bound_npe_continuous=?6,"
              " bound_npe_discrete=?7 WHERE variant=?1 AND realization=?2 AND identifier=?3"),
        parameter(db, "INSERT INTO parameter VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"),
        trace(db, "INSERT INTO trace VALUES (?, ?, ?, ?, ?, ?)") {}

  SQLite::Statement realization, failure, metrics, score, parameter, trace;
};

void InsertParameters(SQLite::Statement& insert, const Result& result, int discrete,
                      const std::vector<ParameterScore>& scores) {
  for (size_t i = 0; i < scores.size(); ++i) {
    const ParameterScore& score = scores[i];
    insert.reset();
    insert.clearBindings();
    // numbers that are absent stay empty
    if (score.covered) insert.bind(10, *score.covered ? 1 : 0);
    insert.bind(11, score.bound);
    Insert(insert, result.variant, result.realization, result.identifier, discrete,
           static_cast<int>(i), score.name, score.truth, score.estimate, score.estimated ? 1 : 0);
  }
}

void InsertTrace(SQLite::Statement& insert, const Result& result, const std::string& plan) {
  // few identifiers have one
  if (result.trace.values.empty()) return;
  insert.reset();
  insert.bind(1, result.variant);
  insert.bind(2, result.realization);
  insert.bind(3, result.identifier);
  insert.bind(4, fmt::format("{}", fmt::join(result.trace.columns, ",")));
  insert.bind(5, result.trace.values.data(),
              static_cast<int>(result.trace.values.size() * sizeof(float)));
  // a digest tells later whether the trace was changed
  const Unit unit{result.variant, result.realization};
  insert.bind(6, DigestOfTrace(plan, unit, result.identifier, result.trace));
  insert.exec();
}

void InsertResult(Inserts& inserts, const Result& result, const std::string& plan) {
  Insert(inserts.failure, result.variant, result.realization, result.identifier, result.status,
         result.message);
  // an answer without figures or score stays without
  if (const auto& m = result.metrics) {
    Insert(inserts.metrics, result.variant, result.realization, result.identifier, m->n,
           m->parameters, m->effective_parameters, m->rmse, m->mae, m->fit, m->fpe);
  }
  if (const auto& s = result.score) {
    Insert(inserts.score, result.variant, result.realization, result.identifier, s->npe_continuous,
           s->npe_discrete, s->bound_npe_continuous, s->bound_npe_discrete);
    InsertParameters(inserts.parameter, result, 0, s->continuous);
    InsertParameters(inserts.parameter, result, 1, s->discrete);
  }
  // how the identifier came to its answer
  InsertTrace(inserts.trace, result, plan);
}

void WriteTimings(SQLite::Database& timings, std::span<const Realization> realizations) {
  SQLite::Transaction transaction(timings);
  // an earlier run may have left timings of the same units
  SQLite::Statement simulation(timings, "INSERT OR REPLACE INTO simulation VALUES (?, ?, ?)");
  SQLite::Statement identification(timings,
                                   "INSERT OR REPLACE INTO identification VALUES (?, ?, ?, ?)");
  for (const Realization& realization : realizations) {
    Insert(simulation, realization.unit.variant, realization.unit.realization,
           realization.simulation_seconds);
    for (const Result& result : realization.results) {
      Insert(identification, result.variant, result.realization, result.identifier, result.seconds);
    }
  }
  transaction.commit();
}

}  // namespace

void RunStore::Write(std::span<const Realization> realizations) {
  // timings first: a kill between the two leaves timings that the next run replaces
  Guarded(timings_file(), [&] { WriteTimings(*timings_, realizations); });

  Guarded(results_file(), [&] {
    // a batch is stored as a whole or not at all
    SQLite::Transaction transaction(results_);
    Inserts inserts(results_);
    for (const Realization& realization : realizations) {
      Insert(inserts.realization, realization.unit.variant, realization.unit.realization,
             DigestOfResults(plan_, realization.unit, realization.results));
      for (const Result& result : realization.results) InsertResult(inserts, result, plan_);
    }
    transaction.commit();
  });
}

}  // namespace warmjoint::inline tools
