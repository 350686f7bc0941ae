#include "tools/report/draw/stacked.h"

#include <algorithm>
#include <numeric>

namespace warmjoint::report {
namespace {

// points; numbers of four digits stand below an axis of half of this three times
constexpr double kNarrowest = 230;
constexpr double kHighest = 0.75;  // of a plot's width

double Sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Whether a plot has less room than it needs.
bool IsNarrow(const Figure& figure) {
  const double all = Sum(figure.columns);
  return std::any_of(figure.panels.begin(), figure.panels.end(), [&](const Panel& panel) {
    if (!std::holds_alternative<Plot>(panel.content) || figure.columns.size() < 2) return false;
    const auto first = figure.columns.begin() + panel.column;
    const double own = std::accumulate(first, first + panel.column_span, 0.0);
    return figure.width * own / all < kNarrowest;
  });
}

/// The height of a panel's rows, points; 0 where its words and tables say it.
double HeightOf(const Panel& panel, const Figure& figure, double head) {
  const auto first = figure.rows.begin() + panel.row;
  const double rows = std::accumulate(first, first + panel.row_span, 0.0);
  const double points =
      figure.height == 0 ? rows : (figure.height - head) * rows / Sum(figure.rows);
  return std::min(points, kHighest * figure.width);
}

}  // namespace

Figure Stacked(Figure figure, double head) {
  if (!IsNarrow(figure)) return figure;
  // panels in the order in which they are read
  std::stable_sort(figure.panels.begin(), figure.panels.end(), [](const Panel& a, const Panel& b) {
    return std::pair(a.row, a.column) < std::pair(b.row, b.column);
  });
  // each has a row of its own over the whole width
  std::vector<double> rows;
  for (const Panel& panel : figure.panels) rows.push_back(HeightOf(panel, figure, head));
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    Panel& panel = figure.panels[i];
    panel.row = static_cast<int>(i);
    panel.column = 0;
    panel.row_span = panel.column_span = 1;
  }
  // the figure is as high as its rows add up to
  figure.rows = rows;
  figure.columns = {1};
  figure.height = 0;
  return figure;
}

}  // namespace warmjoint::report
