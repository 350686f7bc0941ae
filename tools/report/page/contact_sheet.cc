#include "tools/report/page/contact_sheet.h"

#include <fmt/core.h>

#include <algorithm>

namespace warmjoint::report {
namespace {

constexpr int kAcross = 3;
constexpr double kRow = 260;  // points

/// The panel that speaks for its figure: the first that is no text.
const Panel& LeadOf(const Figure& figure) {
  const auto found =
      std::find_if(figure.panels.begin(), figure.panels.end(), [](const auto& panel) {
        return std::holds_alternative<Plot>(panel.content) ||
               std::holds_alternative<Picture>(panel.content);
      });
  return found == figure.panels.end() ? figure.panels.front() : *found;
}

}  // namespace

Figure MakeContactSheet(const std::vector<Figure>& figures) {
  Figure sheet;
  sheet.name = "contact_sheet";
  sheet.height = 0;
  sheet.rows.clear();
  sheet.columns.assign(kAcross, 1);
  sheet.finding = "Contact sheet:";
  for (const Figure& figure : figures) {
    // the leading panel of each figure, a few to a row
    const auto place = static_cast<int>(sheet.panels.size());
    if (place % kAcross == 0) sheet.rows.push_back(kRow);
    const std::string title = figure.title.empty() ? figure.name : figure.title;
    sheet.panels.push_back({title, LeadOf(figure).content, place / kAcross, place % kAcross});
    sheet.finding += fmt::format(" {},", figure.name);
  }
  sheet.finding.back() = '.';
  return sheet;
}

}  // namespace warmjoint::report
