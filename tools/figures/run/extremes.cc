#include "tools/figures/run/extremes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/board/board_tables.h"
#include "tools/figures/fit_panels.h"

namespace warmjoint::figures {
namespace {

constexpr double kRow = 200;  // points

}  // namespace

std::vector<Extreme> ExtremesOf(const RunRow& row) {
  // realizations that have numbers
  std::vector<Extreme> answered;
  for (Eigen::Index i = 0; i < row.npe.size(); ++i) {
    if (std::isnan(row.npe[i])) continue;
    answered.push_back({"", {row.variant[i], row.realization[i]}, row.npe[i]});
  }
  // equal errors in the order of units, so that the choice is the same on every machine
  std::stable_sort(answered.begin(), answered.end(),
                   [](const Extreme& a, const Extreme& b) { return a.npe < b.npe; });

  std::vector<Extreme> extremes;
  // no realization is shown twice
  const auto take = [&](const char* rank, std::size_t at) {
    if (at >= answered.size()) return;
    const bool taken = std::any_of(extremes.begin(), extremes.end(), [&](const Extreme& one) {
      return one.unit == answered[at].unit;
    });
    if (!taken) extremes.push_back({rank, answered[at].unit, answered[at].npe});
  };
  if (answered.empty()) return extremes;
  take("best", 0);
  take("median", (answered.size() - 1) / 2);
  take("worst", answered.size() - 1);
  return extremes;
}

Figure ExtremesFigure(const std::string& label, const std::vector<ReplayedExtreme>& replayed) {
  Figure figure;
  figure.name = "extremes";
  figure.title = "Torque and fit of the best, the median and the worst realization";
  figure.subtitle = fmt::format("{}, by the NPE of its parameters; simulated once more", label);
  figure.finding =
      "Left: measured torque in the direction of motion with the fit. Right: the last segments as "
      "they were logged. Where even the worst fit follows its torque, the errors of the parameters "
      "are what noise leaves.";
  figure.height = 0;
  figure.rows.clear();
  figure.columns = {1, 1};
  // a row for each: its whole recording, and its end close up
  for (const ReplayedExtreme& one : replayed) {
    const auto row = static_cast<int>(figure.rows.size());
    figure.rows.push_back(kRow);
    const Window warm = WarmWindow(one.view);
    figure.panels.push_back({fmt::format("The {}: {}, NPE {}", one.extreme.rank, one.name,
                                         PercentText(one.extreme.npe)),
                             LevelOverTime(one.view), row, 0});
    figure.panels.push_back(
        {"Its last segments", CloseUp(one.view, warm, TorqueLimits(one.view, warm, warm)), row, 1});
  }
  return figure;
}

}  // namespace warmjoint::figures
