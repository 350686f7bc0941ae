// Reading results back.
#include <cstring>
#include <iterator>
#include <sstream>

#include "tools/store/digest.h"
#include "tools/store/open_database.h"
#include "tools/store/run_store.h"
#include "tools/store/unit_reader.h"

namespace warmjoint::inline tools {

namespace {

/// A row of the table of traces, checked against its digest.
TraceTable ReadTraceRow(SQLite::Statement& row, const std::string& plan, const Place& place) {
  const Unit unit{row.getColumn(0).getInt(), row.getColumn(1).getInt()};
  TraceTable trace;
  // names of the columns, then all numbers in one piece
  std::istringstream columns(row.getColumn(3).getString());
  for (std::string name; std::getline(columns, name, ',');) trace.columns.push_back(name);
  const SQLite::Column blob = row.getColumn(4);
  trace.values.resize(static_cast<size_t>(blob.getBytes()) / sizeof(float));
  if (!trace.values.empty()) {
    std::memcpy(trace.values.data(), blob.getBlob(), trace.values.size() * sizeof(float));
  }
  // a trace that was changed after the run is not read
  const std::string digest = DigestOfTrace(plan, unit, row.getColumn(2).getInt(), trace);
  if (digest != row.getColumn(5).getString()) RefuseChangedUnit(unit, place);
  return trace;
}

}  // namespace

void RunStore::ForEachFinished(const std::function<void(Unit)>& work) const {
  SQLite::Statement row(
      results_, "SELECT variant, realization FROM realization ORDER BY variant, realization");
  while (row.executeStep()) work({row.getColumn(0).getInt(), row.getColumn(1).getInt()});
}

std::set<Unit> RunStore::Finished() const {
  std::set<Unit> finished;
  ForEachFinished([&](Unit unit) { finished.insert(finished.end(), unit); });
  return finished;
}

std::map<std::string, int> RunStore::CountStatuses() const {
  std::map<std::string, int> counts;
  SQLite::Statement row(results_, "SELECT status, count(*) FROM result GROUP BY status");
  while (row.executeStep()) counts[row.getColumn(0).getString()] = row.getColumn(1).getInt();
  return counts;
}

void RunStore::ForEachUnit(const std::function<void(std::vector<Result>)>& work) const {
  Guarded(results_file(), [&] {
    UnitReader reader(results_, timings_ ? &*timings_ : nullptr, DigestOfPlan(ReadDescription()),
                      {results_file().string()});
    while (auto unit = reader.Next()) work(*std::move(unit));
  });
}

std::vector<Result> RunStore::ReadResults() const {
  std::vector<Result> all;
  ForEachUnit([&](std::vector<Result> unit) {
    std::move(unit.begin(), unit.end(), std::back_inserter(all));
  });
  return all;
}

void RunStore::Verify() const {
  // reading compares the digest of every unit, and here of every trace
  ForEachUnit([](const std::vector<Result>&) {});
  Guarded(results_file(), [&] {
    const std::string plan = DigestOfPlan(ReadDescription());
    SQLite::Statement row(results_,
                          "SELECT * FROM trace ORDER BY variant, realization, identifier");
    while (row.executeStep()) ReadTraceRow(row, plan, {results_file().string()});
  });
}

TraceTable RunStore::ReadTrace(Unit unit, int identifier) const {
  return Guarded(results_file(), [&] {
    SQLite::Statement row(
        results_, "SELECT * FROM trace WHERE variant = ? AND realization = ? AND identifier = ?");
    row.bind(1, unit.variant);
    row.bind(2, unit.realization);
    row.bind(3, identifier);
    if (!row.executeStep()) return TraceTable{};
    return ReadTraceRow(row, DigestOfPlan(ReadDescription()), {results_file().string()});
  });
}

std::map<Unit, double> RunStore::ReadSimulationSeconds() const {
  std::map<Unit, double> seconds;
  if (!timings_) return seconds;
  return Guarded(timings_file(), [&] {
    SQLite::Statement row(*timings_, "SELECT variant, realization, seconds FROM simulation");
    while (row.executeStep()) {
      seconds[{row.getColumn(0).getInt(), row.getColumn(1).getInt()}] =
          StoredNumber(row.getColumn(2));
    }
    return seconds;
  });
}

}  // namespace warmjoint::inline tools
