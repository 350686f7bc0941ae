#include "tools/figures/run/run_page.h"

#include <nlohmann/json.hpp>

#include "tools/actions/replay_unit.h"
#include "tools/board/board_tables.h"
#include "tools/board/format_board.h"
#include "tools/figures/run/run_words.h"

namespace warmjoint::figures {
namespace {

// the run's directory, as the page calls it
constexpr const char* kRun = "RUN";

using BoardTable = warmjoint::Table;

Tree TableTree(const std::string& caption, const BoardTable& table) {
  return {{"caption", caption}, {"header", table.header}, {"rows", table.rows}};
}

/// Each answer with how well it did, and how to make its log again.
BoardTable RealizationTable(const RunPage& page) {
  const Suite& suite = page.suite;
  BoardTable table{
      {"realization", "identifier", "answer", "NPE",
       fmt::format("RMSE ({})", page.view.torque_unit), "Fit (%)", "simulate it again"},
      {}};
  if (suite.ladder) table.header.insert(table.header.begin() + 1, "variant");
  for (const ListedAnswer& answer : page.view.listing.answers) {
    std::vector<std::string> row{
        fmt::format("{}", answer.unit.realization),
        suite.identifiers.at(static_cast<std::size_t>(answer.identifier)).label,
        answer.status,
        PercentText(answer.npe),
        warmjoint::NumberText(answer.rmse),
        warmjoint::NumberText(answer.fit),
        ReplayCommand(suite, answer.unit, kRun)};
    // the variant stands behind the realization where there are variants
    if (suite.ladder) {
      const auto variant = static_cast<std::size_t>(answer.unit.variant);
      row.insert(row.begin() + 1, suite.ladder->variants.at(variant).name);
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// The tables of `compare`.
Tree BoardTrees(const Leaderboard& board) {
  Tree tables = {TableTree("Who wins: normalised parameter error, NPE", RankingTable(board)),
                 TableTree("Agreement with the data, medians", AgreementTable(board))};
  // variants beside each other, where there are some
  if (!board.groups.empty()) {
    tables.push_back(TableTree("Rms NPE in each variant, beside its bound", GroupTable(board)));
  }
  const BoardTable parameters = ParameterTable(board);
  if (!parameters.rows.empty()) {
    tables.push_back(TableTree("Each parameter beside its Cramér-Rao bound", parameters));
  }
  return tables;
}

}  // namespace

Tree RunPageData(const RunPage& page) {
  const Leaderboard& board = page.view.board;
  Tree identifiers = Tree::array(), pictures = Tree::array();
  for (const SuiteIdentifier& one : page.suite.identifiers) {
    identifiers.push_back({one.label, WhatItIs(one)});
  }
  for (const Figure& figure : page.figures) pictures.push_back(FigureJson(figure));
  return {{"suite", board.suite},
          {"question", board.question},
          {"verdict", Verdict(board)},
          {"simulated", WhatWasSimulated(page.suite)},
          {"identifiers", std::move(identifiers)},
          {"boards", BoardTrees(board)},
          {"extremes", page.extremes ? FigureJson(*page.extremes) : Tree()},
          {"without_extremes", page.without_extremes},
          {"every", page.view.listing.every},
          {"realizations",
           TableTree("Every answer; a click on a heading sorts", RealizationTable(page))},
          {"figures", std::move(pictures)},
          {"notes", Notes(board)},
          {"terms", RunTerms()},
          {"run", kRun},
          {"finished", board.finished},
          {"all", board.realizations},
          {"versions", page.description.versions},
          {"suite_yaml", page.description.suite_yaml},
          {"board", Tree::parse(BoardToJson(board))}};
}

}  // namespace warmjoint::figures
