// Results as one text table.
#pragma once

#include <string>
#include <vector>

#include "tools/store/result.h"

namespace warmjoint {

/// A text for one cell: quoted where it holds a comma, a quote or a line break.
std::string CsvCell(const std::string& text);

/// One row for each (realization, identifier), in that order; numbers read back bit for bit, empty
/// where unknown. Columns: status, metrics, NPE and their bounds; then for each parameter its
/// estimate, truth, Cramer-Rao bound and whether the 95 % interval covered the truth (1 or 0).
/// labels: of the identifiers, by position.
std::string ResultsToCsv(const std::vector<Result>& results,
                         const std::vector<std::string>& labels);

}  // namespace warmjoint
