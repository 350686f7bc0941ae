// The results of a run one unit after the other, so that memory does not grow with the run.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <optional>
#include <string>
#include <vector>

#include "models/foundation/bad_input.h"
#include "tools/store/result.h"

namespace warmjoint::inline tools {

/// Walks through a store in the order of (variant, realization). Each unit is checked against the digest
/// that was stored with it.
class UnitReader {
 public:
  /// timings: nullptr where they are lost. plan: DigestOfPlan. place: what refusals name.
  UnitReader(const SQLite::Database& results, const SQLite::Database* timings, std::string plan,
             Place place);

  /// The next unit's results in the order of identifiers, without traces; nothing after the last. Throws
  /// BadInput for a unit that is not what the run stored.
  std::optional<std::vector<Result>> Next();

 private:
  /// Rows of one table in the order of its key, whose first columns are variant and realization.
  struct Rows {
    Rows(const SQLite::Database& database, const char* query);
    void Step() { open = row.executeStep(); }
    Unit unit();
    int identifier() { return row.getColumn(2).getInt(); }

    SQLite::Statement row;
    bool open = false;  // stands on a row
  };

  Result ReadResult();
  void ReadParameters(Result& result);
  double ReadSeconds(const Result& result);

  std::string plan_;
  Place place_;
  Rows realizations_, results_, parameters_;
  std::optional<Rows> seconds_;
};

/// A stored number; NULL stands for NaN.
double StoredNumber(const SQLite::Column& column);

/// Refuses a unit whose stored digest is another.
[[noreturn]] void RefuseChangedUnit(Unit unit, const Place& place);

}  // namespace warmjoint::inline tools
