#include "tools/board/write_tables.h"

#include <limits>

#include "models/foundation/atomic_file.h"
#include "tools/board/board_builder.h"
#include "tools/board/format_board.h"
#include "tools/store/export_csv.h"
#include "tools/store/stored_suite.h"

namespace warmjoint::inline tools {

std::size_t WriteTables(const RunStore& store) {
  const std::size_t results = ExportResults(store);
  BoardBuilder builder(StoredSuite(store));
  store.ForEachUnit([&](std::vector<Result> unit) {
    for (Result& result : unit) result.seconds = std::numeric_limits<double>::quiet_NaN();
    builder.Add(unit);
  });
  WriteWholeFile(store.directory() / "summary.csv", SummaryToCsv(builder.Finish()));
  return results;
}

}  // namespace warmjoint::inline tools
