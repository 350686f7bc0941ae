// Rows of a store that others may have changed.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include "models/foundation/bad_input.h"
#include "tools/store/run_description.h"

namespace warmjoint::inline tools {

/// Throws BadInput from `place` for a row of results whose variant, realization or identifier the
/// run does not have, for a result without its realization, and for positions of names with gaps.
/// From here on every index of the store is one into the description's lists.
void CheckRows(const SQLite::Database& results, const RunDescription& description,
               const Place& place);

}  // namespace warmjoint::inline tools
