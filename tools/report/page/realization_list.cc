#include "tools/report/page/realization_list.h"

#include <fmt/format.h>

#include "tools/actions/replay_unit.h"
#include "tools/board/board_tables.h"
#include "tools/report/page/html.h"
#include "tools/report/page/realization_script.h"

namespace warmjoint::report {
namespace {

using BoardTable = warmjoint::Table;

BoardTable TableOf(const RunView& view, const Suite& suite, const std::string& run) {
  BoardTable table{{"realization", "identifier", "answer", "NPE",
                    fmt::format("RMSE ({})", view.torque_unit), "Fit (%)", "simulate it again"},
                   {}};
  if (suite.ladder) table.header.insert(table.header.begin() + 1, "variant");
  for (const ListedAnswer& answer : view.listing.answers) {
    // who answered what on which log, how well, and how to make that log again
    std::vector<std::string> row{
        fmt::format("{}", answer.unit.realization),
        suite.identifiers.at(static_cast<std::size_t>(answer.identifier)).label,
        answer.status,
        PercentText(answer.npe),
        warmjoint::NumberText(answer.rmse),
        warmjoint::NumberText(answer.fit),
        ReplayCommand(suite, answer.unit, run)};
    // the variant stands behind the realization where there are variants
    if (suite.ladder) {
      const auto variant = static_cast<std::size_t>(answer.unit.variant);
      row.insert(row.begin() + 1, suite.ladder->variants.at(variant).name);
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

std::string RealizationList(const RunView& view, const Suite& suite, const std::string& run) {
  std::string html;
  // long runs list a part of their realizations
  if (view.listing.every > 1) {
    html += Paragraph(fmt::format(
        "One realization in {} is listed, and the first failures besides.", view.listing.every));
  }
  html +=
      "<p id=\"choose\" role=\"group\" aria-label=\"Rows that are shown\" hidden></p>\n"
      "<p id=\"shown\" role=\"status\"></p>\n";
  return html + "<div id=\"list\">\n" +
         HtmlTable("Every answer; a click on a heading sorts", TableOf(view, suite, run)) +
         "</div>\n";
}

std::string_view RealizationStyle() {
  return R"(
#list .scroll { max-height: 32rem; overflow: auto; }
#list thead th { position: sticky; top: 0; background: var(--paper); z-index: 1; }
#list thead th.name { z-index: 2; }
#list thead button { font: inherit; font-weight: 600; color: inherit; background: none; border: 0; padding: 0; cursor: pointer; }
#list th[aria-sort=ascending] button::after { content: " \2191"; } #list th[aria-sort=descending] button::after { content: " \2193"; }
#list td:last-child { font-family: monospace; font-size: .85rem; }
#choose label { white-space: nowrap; margin-right: 1rem; } select { font: inherit; max-width: 16rem; }
@media print { #list .scroll { max-height: none; } #choose { display: none; } }
)";
}

std::string_view RealizationScript() { return kRealizationScript; }

}  // namespace warmjoint::report
