// `compare --format csv`, and the tables that a run leaves.
#include <fmt/format.h>

#include <cmath>

#include "models/foundation/atomic_file.h"
#include "tools/board/board_tables.h"
#include "tools/board/format_board.h"
#include "tools/store/export_csv.h"

namespace warmjoint {
namespace {

std::string Cell(double value) {
  return std::isfinite(value) ? fmt::format(",{}", value) : std::string(",");
}

std::string Cells(const Summary& summary) {
  return Cell(summary.median) + Cell(summary.q25) + Cell(summary.q75);
}

std::string Row(const LeaderboardRow& row) {
  std::string line = fmt::format("{},{},{}", CsvCell(row.identifier), row.runs, row.failed());
  line += Cells(row.npe_continuous) + Cell(row.npe_continuous.rms);
  line += Cells(row.npe_discrete) + Cell(row.npe_discrete.rms);
  line += Cells(row.rmse) + Cells(row.fit) + Cells(row.fpe) + Cells(row.mae);
  return line + Cell(row.seconds.median) + "\n";
}

std::string Header() {
  // both errors of parameters have a root mean square too, the figures of a fit have none
  std::string header = "variant,identifier,runs,failed";
  for (const char* name : {"npe_continuous", "npe_discrete"}) {
    header += fmt::format(",{0}_median,{0}_q25,{0}_q75,{0}_rms", name);
  }
  for (const char* name : {"rmse", "fit", "fpe", "mae"}) {
    header += fmt::format(",{0}_median,{0}_q25,{0}_q75", name);
  }
  return header + ",seconds_median\n";
}

/// A row for each identifier, of a ladder for each in every variant. before: the cells that each row begins with.
std::string Rows(const Leaderboard& board, const std::string& before) {
  std::string csv;
  for (const auto& [variant, part] : PartsOf(board)) {
    for (const LeaderboardRow& row : part->rows) csv += before + CsvCell(variant) + "," + Row(row);
  }
  return csv;
}

}  // namespace

std::string BoardToCsv(const Leaderboard& board) { return Header() + Rows(board, ""); }

std::string BoardsToCsv(const std::vector<NamedBoard>& boards) {
  std::string csv = "run," + Header();
  for (const NamedBoard& named : boards) csv += Rows(named.board, CsvCell(named.run) + ",");
  return csv;
}

void WriteTables(const RunStore& store) {
  ExportResults(store);
  // wall times differ from run to run
  Leaderboard board = ReadBoard(store);
  const auto forget = [](Standing& part) {
    for (LeaderboardRow& row : part.rows) row.seconds.median = std::nan("");
  };
  forget(board);
  for (VariantStanding& group : board.groups) forget(group);
  WriteWholeFile(store.directory() / "summary.csv", BoardToCsv(board));
}

}  // namespace warmjoint
