// Results as one text table.
#pragma once

#include <string>
#include <vector>

#include "tools/store/run_store.h"

namespace warmjoint {

/// A text for one cell: quoted where it holds a comma, a quote or a line break; an apostrophe stands
/// before what a spreadsheet would take for a formula.
std::string CsvCell(const std::string& text);

/// The parameters that a table has columns for: the continuous ones in the order in which they came, then
/// those that only the discrete family has.
class CsvColumns {
 public:
  void Add(const Result& result);
  std::vector<std::string> Names() const;
  /// What compensators reach, in the order in which it came.
  const std::vector<std::string>& Measures() const { return measures_; }

 private:
  std::vector<std::string> continuous_, discrete_, measures_;
};

/// The first line. The column variant is there when the suite has a ladder.
std::string CsvHeader(const CsvColumns& columns, const Suite& suite);

/// One result as a line; numbers read back bit for bit, empty where unknown. Columns: status, metrics, NPE
/// and their bounds; what compensators reach; then for each parameter its estimate, truth, Cramer-Rao bound and whether the 95 %
/// interval covered the truth (1 or 0).
std::string CsvRow(const Result& result, const CsvColumns& columns, const Suite& suite);

/// Writes RUN/results.csv from all that the store holds, a row for each (variant, realization,
/// identifier) in that order. Memory does not grow with the run.
void ExportResults(const RunStore& store);

}  // namespace warmjoint
