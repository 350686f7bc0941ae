// Results as one text table.
#pragma once

#include <string>
#include <vector>

#include "tools/store/result.h"
#include "tools/store/run_description.h"
#include "tools/store/run_store.h"

namespace warmjoint::inline tools {

/// A text for one cell: quoted where it holds a comma, a quote or a line break; an apostrophe stands
/// before what a spreadsheet would take for a formula.
std::string CsvCell(const std::string& text);

/// One row for each (variant, realization, identifier), in that order; numbers read back bit for
/// bit, empty where unknown. Columns: status, metrics, NPE and their bounds; then for each
/// parameter its estimate, truth, Cramer-Rao bound and whether the 95 % interval covered the truth
/// (1 or 0). The column variant is there when the suite has a ladder. description: names by
/// position.
std::string ResultsToCsv(const std::vector<Result>& results, const RunDescription& description);

/// Writes RUN/results.csv from all that the store holds; returns what it wrote.
std::vector<Result> ExportResults(const RunStore& store);

}  // namespace warmjoint::inline tools
