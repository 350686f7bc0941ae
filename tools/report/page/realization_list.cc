#include "tools/report/page/realization_list.h"

#include <fmt/format.h>

#include "tools/actions/replay_unit.h"
#include "tools/board/board_tables.h"
#include "tools/report/page/html.h"

namespace warmjoint::report {
namespace {

/// What sorts and filters the answers of a run in a browser.
constexpr std::string_view kRealizationScript = R"(
(function () {
  'use strict';
  var table = document.querySelector('#list table'), body = table.tBodies[0];
  var heads = Array.prototype.slice.call(table.tHead.rows[0].cells), rows = Array.prototype.slice.call(body.rows);
  var choose = document.getElementById('choose'), shown = document.getElementById('shown'), wanted = {};
  function text(row, column) { return row.cells[column].textContent; }
  function compare(a, b) {
    var x = parseFloat(a), y = parseFloat(b);
    if (isNaN(x) || isNaN(y)) return isNaN(x) && isNaN(y) ? a.localeCompare(b) : isNaN(x) ? 1 : -1;
    return x - y || a.localeCompare(b);
  }
  function filter() {
    var count = 0;
    rows.forEach(function (row) {
      row.hidden = Object.keys(wanted).some(function (column) { return wanted[column] && text(row, column) !== wanted[column]; });
      count += row.hidden ? 0 : 1;
    });
    shown.textContent = count + ' of ' + rows.length + ' rows are shown.';
  }
  function choice(column) {
    var values = rows.map(function (row) { return text(row, column); })
      .filter(function (value, i, all) { return all.indexOf(value) === i; });
    if (values.length < 2) return;
    var label = document.createElement('label'), list = document.createElement('select');
    label.textContent = heads[column].textContent + ' ';
    [''].concat(values).forEach(function (value) {
      var option = document.createElement('option');
      option.value = value;
      option.textContent = value || 'all';
      list.appendChild(option);
    });
    list.addEventListener('change', function () { wanted[column] = list.value; filter(); });
    label.appendChild(list);
    choose.appendChild(label);
    choose.hidden = false;
  }
  heads.forEach(function (head, column) {
    var button = document.createElement('button'), name = head.textContent;
    if (['variant', 'identifier', 'answer'].indexOf(name) >= 0) choice(column);
    button.type = 'button';
    button.textContent = name;
    head.textContent = '';
    head.appendChild(button);
    button.addEventListener('click', function () {
      var sign = head.getAttribute('aria-sort') === 'ascending' ? -1 : 1;
      heads.forEach(function (other) { other.removeAttribute('aria-sort'); });
      head.setAttribute('aria-sort', sign > 0 ? 'ascending' : 'descending');
      // cells without a number stay last
      rows.sort(function (a, b) {
        var x = text(a, column), y = text(b, column);
        return x === '-' || y === '-' ? (x === '-') - (y === '-') : sign * compare(x, y);
      });
      rows.forEach(function (row) { body.appendChild(row); });
    });
  });
  filter();
}());
)";

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
