#include "tools/board/format_board.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "models/foundation/atomic_file.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/serialize.h"
#include "tools/board/board_tables.h"
#include "tools/store/export_csv.h"

namespace warmjoint {
namespace {

std::string Head(const Leaderboard& board) {
  if (Compensates(board)) {
    return fmt::format(
        "{} realizations. Residual: true friction less the compensator's, in % of the friction's "
        "rms, "
        "while the speed is steady. Push: the smallest that an alarm sees which errs once an hour.",
        board.finished);
  }
  return fmt::format(
      "{} realizations. NPE: relative error over all parameters of the truth, Eq. (26) of the "
      "paper.",
      board.finished);
}

/// Every identifier of every run, of a ladder in each of its variants.
Table SideBySide(const std::vector<NamedBoard>& boards) {
  Table table{{"run", "identifier", "failed", "NPE median", "NPE rms", "rms bound"}, {}};
  for (const NamedBoard& named : boards) {
    for (const auto& [variant, part] : PartsOf(named.board)) {
      std::string run = named.board.groups.empty() ? named.run : named.run + ": " + variant;
      // the run is named once for all of its identifiers
      for (const LeaderboardRow& row : part->rows) {
        table.rows.push_back({run, row.identifier, std::to_string(row.failed()),
                              PercentText(row.npe_continuous.median),
                              PercentText(row.npe_continuous.rms),
                              PercentText(part->bound_npe_continuous)});
        run.clear();
      }
    }
  }
  return table;
}

/// Who is how good, how well torques agree and parameters are known, and what remains to be said.
std::string TablesAndNotes(const Leaderboard& board,
                           const std::function<std::string(const Table&, size_t)>& write,
                           const char* bullet) {
  std::string text = write(RankingTable(board), 2) + "\n";
  // variants beside each other, where there are some
  if (Compensates(board)) {
    text += write(MeasureTable(board), board.groups.empty() ? 1 : 2) + "\n";
    for (const std::string& note : Notes(board)) text += fmt::format("{} {}\n", bullet, note);
    return text;
  }
  const Table groups = GroupTable(board);
  if (!groups.rows.empty()) {
    text += fmt::format("Rms NPE in each variant, and the bound:\n\n{}\n", write(groups, 1));
  }
  text += write(AgreementTable(board), board.groups.empty() ? 1 : 2) + "\n";
  const Table parameters = ParameterTable(board);
  if (!parameters.rows.empty()) text += write(parameters, 2) + "\n";
  for (const std::string& note : Notes(board)) text += fmt::format("{} {}\n", bullet, note);
  return text;
}

/// Markdown in which nothing is HTML, and on which no terminal acts.
std::string Harmless(const std::string& markdown) {
  std::string text;
  for (const char c : PrintableLines(markdown)) {
    text += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  }
  return text;
}

// `compare --format csv`, and the tables that a run leaves.

std::string Cell(double value) {
  return std::isfinite(value) ? fmt::format(",{}", value) : std::string(",");
}

std::string Cells(const Summary& summary) {
  return Cell(summary.median) + Cell(summary.q25) + Cell(summary.q75);
}

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr Summary kNoSummary{{kNone, kNone, kNone}, kNone};

std::string Row(const LeaderboardRow& row, const std::vector<std::string>& measures) {
  std::string line = fmt::format("{},{},{}", CsvCell(row.identifier), row.runs, row.failed());
  line += Cells(row.npe_continuous) + Cell(row.npe_continuous.rms);
  line += Cells(row.npe_discrete) + Cell(row.npe_discrete.rms);
  line += Cells(row.rmse) + Cells(row.fit) + Cells(row.fpe) + Cells(row.mae);
  line += Cell(row.seconds.median);
  // what a compensator reaches
  for (const std::string& name : measures) {
    const auto named = [&](const MeasureRow& one) { return one.name == name; };
    const auto found = std::ranges::find_if(row.measures, named);
    line += Cells(found == row.measures.end() ? kNoSummary : found->summary);
  }
  return line + "\n";
}

/// The measures that boards have, in their order.
std::vector<std::string> MeasuresOf(const Leaderboard& board) {
  std::vector<std::string> names;
  for (const LeaderboardRow& row : board.rows) {
    if (row.measures.size() <= names.size()) continue;
    names.clear();
    for (const MeasureRow& one : row.measures) names.push_back(one.name);
  }
  return names;
}

std::string Header(const std::vector<std::string>& measures) {
  // both errors of parameters have a root mean square too, the figures of a fit have none
  std::string header = "variant,identifier,runs,failed";
  for (const char* name : {"npe_continuous", "npe_discrete"}) {
    header += fmt::format(",{0}_median,{0}_q25,{0}_q75,{0}_rms", name);
  }
  for (const char* name : {"rmse", "fit", "fpe", "mae"}) {
    header += fmt::format(",{0}_median,{0}_q25,{0}_q75", name);
  }
  header += ",seconds_median";
  for (const std::string& name : measures) {
    header += fmt::format(",{0}_median,{0}_q25,{0}_q75", name);
  }
  return header + "\n";
}

/// A row for each identifier, of a ladder for each in every variant. before: the cells that each row begins with.
std::string Rows(const Leaderboard& board, const std::string& before,
                 const std::vector<std::string>& measures) {
  std::string csv;
  for (const auto& [variant, part] : PartsOf(board)) {
    for (const LeaderboardRow& row : part->rows)
      csv += before + CsvCell(variant) + "," + Row(row, measures);
  }
  return csv;
}

}  // namespace

const std::vector<BoardFormat>& BoardFormats() {
  static const std::vector<BoardFormat> formats{
      {"text", BoardToText, BoardsToText},
      {"markdown", BoardToMarkdown, BoardsToMarkdown},
      {"json", BoardToJson, BoardsToJson},
      {"csv", BoardToCsv, BoardsToCsv},
  };
  return formats;
}

std::string BoardToText(const Leaderboard& board, const Page& page) {
  const auto write = [&page](const Table& table, size_t left) {
    return TableToText(table, left, page);
  };
  return PrintableLines(fmt::format("{}: {}\n{}\n{}\n\n{}", board.suite, board.question,
                                    Verdict(board), Head(board),
                                    TablesAndNotes(board, write, "*")));
}

std::string BoardToMarkdown(const Leaderboard& board, const Page& /*page*/) {
  return Harmless(fmt::format("### {}\n\n{}\n\n**{}** {}\n\n{}", board.suite, board.question,
                              Verdict(board), Head(board),
                              TablesAndNotes(board, TableToMarkdown, "-")));
}

std::string BoardToJson(const Leaderboard& board, const Page& /*page*/) {
  return WriteFields(board).dump(2) + "\n";
}

std::string BoardsToText(const std::vector<NamedBoard>& boards, const Page& page) {
  std::string text = PrintableLines(TableToText(SideBySide(boards), 2, page));
  for (const NamedBoard& named : boards)
    text += fmt::format("\n{}", BoardToText(named.board, page));
  return text;
}

std::string BoardsToMarkdown(const std::vector<NamedBoard>& boards, const Page& /*page*/) {
  std::string text = Harmless(TableToMarkdown(SideBySide(boards), 2));
  for (const NamedBoard& named : boards) text += fmt::format("\n{}", BoardToMarkdown(named.board));
  return text;
}

std::string BoardsToJson(const std::vector<NamedBoard>& boards, const Page& /*page*/) {
  Tree runs = Tree::array();
  for (const NamedBoard& named : boards) {
    runs.push_back({{"run", named.run}});
    runs.back().update(WriteFields(named.board));
  }
  return Tree{{"runs", std::move(runs)}}.dump(2) + "\n";
}

std::string BoardToCsv(const Leaderboard& board, const Page& /*page*/) {
  const std::vector<std::string> measures = MeasuresOf(board);
  return Header(measures) + Rows(board, "", measures);
}

std::string BoardsToCsv(const std::vector<NamedBoard>& boards, const Page& /*page*/) {
  std::vector<std::string> measures;
  for (const NamedBoard& named : boards) {
    std::vector<std::string> own = MeasuresOf(named.board);
    if (own.size() > measures.size()) measures = std::move(own);
  }
  std::string csv = "run," + Header(measures);
  for (const NamedBoard& named : boards) {
    csv += Rows(named.board, CsvCell(named.run) + ",", measures);
  }
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

Leaderboard ReadLeaderboard(const std::filesystem::path& directory) {
  return ReadBoard(RunStore::OpenToRead(directory));
}

std::string FormatLeaderboard(const std::filesystem::path& directory, const std::string& format) {
  // the formats are those of `compare`
  std::vector<std::string> known;
  for (const BoardFormat& one : BoardFormats()) {
    known.push_back(one.name);
    if (one.name == format) return one.write(ReadLeaderboard(directory), {});
  }
  Refuse({"--format"}, "is '{}'{}", Excerpt(format), Suggestion(format, known));
}

}  // namespace warmjoint
