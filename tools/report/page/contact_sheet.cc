#include "tools/report/page/contact_sheet.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>

namespace warmjoint::report {

Figure MakeContactSheet(std::vector<std::pair<std::string, Image>> pictures, int across,
                        int width) {
  // pictures of like proportions share a row
  std::stable_sort(pictures.begin(), pictures.end(), [](const auto& a, const auto& b) {
    return std::int64_t{a.second.height} * b.second.width <
           std::int64_t{b.second.height} * a.second.width;
  });
  constexpr double kTitle = 20;  // points
  const double margins = 2.0 * size::kMargin + (across - 1.0) * size::kGap;
  const double cell = (width - margins) / across;
  Figure sheet;
  sheet.name = "contact_sheet";
  sheet.width = width;
  sheet.columns.assign(static_cast<std::size_t>(across), 1);
  sheet.rows.clear();
  sheet.finding = "Contact sheet:";
  double height = 2 * size::kMargin + 12;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const auto& [name, image] = pictures[i];
    const int row = static_cast<int>(i) / across, column = static_cast<int>(i) % across;
    if (column == 0) sheet.rows.push_back(0);
    // a row is as high as its highest picture
    const double wanted = kTitle + cell * image.height / image.width;
    sheet.rows.back() = std::max(sheet.rows.back(), wanted);
    sheet.panels.push_back({name, Picture{image}, row, column});
    sheet.finding += fmt::format(" {},", name);
  }
  sheet.finding.back() = '.';
  for (double row : sheet.rows) height += row + size::kGap;
  sheet.height = static_cast<int>(height);
  return sheet;
}

}  // namespace warmjoint::report
