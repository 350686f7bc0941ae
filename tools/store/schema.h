// The tables of a run's databases.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include "models/foundation/bad_input.h"
#include "tools/store/run_description.h"

namespace warmjoint::inline tools {

/// Makes the tables of results.sqlite and stores the description, as a whole or not at all.
void CreateResultTables(SQLite::Database& results, const RunDescription& description);

/// Makes the tables of timings.sqlite, as a whole or not at all.
void CreateTimingTables(SQLite::Database& timings);

/// Whether the database holds no tables yet.
bool IsEmpty(const SQLite::Database& database);

/// Throws BadInput from `place` when the tables are of another version than this program's, or are
/// not exactly the tables of that version: a view or trigger is a program of someone else's.
void CheckSchema(const SQLite::Database& results, const Place& place);
void CheckTimingSchema(const SQLite::Database& timings, const Place& place);

/// The description that CreateResultTables stored.
RunDescription ReadStoredDescription(const SQLite::Database& results);

}  // namespace warmjoint::inline tools
