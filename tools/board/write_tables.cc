#include "tools/board/write_tables.h"

#include "models/foundation/atomic_file.h"
#include "tools/board/format_board.h"
#include "tools/board/read_board.h"
#include "tools/store/export_csv.h"

namespace warmjoint::inline tools {

std::size_t WriteTables(const RunStore& store) {
  const std::size_t results = ExportResults(store);
  WriteWholeFile(store.directory() / "summary.csv", SummaryToCsv(ReadBoard(store)));
  return results;
}

}  // namespace warmjoint::inline tools
