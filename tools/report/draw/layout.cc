#include "tools/report/draw/layout.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "tools/report/draw/draw_plot.h"

namespace warmjoint::report {
namespace {

/// Edges of tracks of the given relative sizes with gaps between, from `begin` to `end`.
std::vector<std::pair<float, float>> Tracks(const std::vector<double>& shares, float begin,
                                            float end) {
  const double total = std::accumulate(shares.begin(), shares.end(), 0.0);
  const float room = end - begin - size::kGap * static_cast<float>(shares.size() - 1);
  std::vector<std::pair<float, float>> tracks;
  float at = begin;
  for (double share : shares) {
    const float length = room * static_cast<float>(share / total);
    tracks.emplace_back(at, at + length);
    at += length + size::kGap;
  }
  return tracks;
}

float TitleHeight(const Pen& pen, const Panel& panel) {
  if (panel.title.empty()) return 0;
  return pen.Measure(panel.title, {size::kText, true}).y + 4;
}

/// Keeps the largest value for each key.
void Widen(std::map<int, float>& widest, int key, float value) {
  widest[key] = std::max(widest[key], value);
}

}  // namespace

std::vector<PanelPlace> LayOut(const Pen& pen, const Figure& figure, float top) {
  const auto columns =
      Tracks(figure.columns, size::kMargin, static_cast<float>(figure.width) - size::kMargin);
  const auto rows = Tracks(figure.rows, top, static_cast<float>(figure.height) - size::kMargin);

  std::vector<PanelPlace> places;
  std::map<int, float> left, right, upper, bottom;  // by first or last column or row
  for (const Panel& panel : figure.panels) {
    PanelPlace place;
    place.cell = {columns[panel.column].first, rows[panel.row].first,
                  columns[panel.column + panel.column_span - 1].second,
                  rows[panel.row + panel.row_span - 1].second};
    float head = TitleHeight(pen, panel);
    if (const auto* plot = std::get_if<Plot>(&panel.content)) {
      const Margins margins =
          PlotMargins(pen, *plot, {0.85f * place.cell.width(), 0.7f * place.cell.height()});
      const float legend = LegendHeight(pen, *plot, place.cell.width());
      head += legend + (legend > 0 ? 4.0f : 2.0f);
      Widen(left, panel.column, margins.left);
      Widen(right, panel.column + panel.column_span - 1, margins.right);
      Widen(bottom, panel.row + panel.row_span - 1, margins.bottom);
      Widen(upper, panel.row, head);
    }
    place.content = place.cell.top + head;
    place.area = {place.cell.left, place.content, place.cell.right, place.cell.bottom};
    places.push_back(place);
  }

  // plots in line with their neighbours
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Panel& panel = figure.panels[i];
    if (!std::holds_alternative<Plot>(panel.content)) continue;
    Rectangle& area = places[i].area;
    area.left += left[panel.column];
    area.right -= right[panel.column + panel.column_span - 1];
    area.top = places[i].cell.top + upper[panel.row];
    area.bottom -= bottom[panel.row + panel.row_span - 1];
  }
  return places;
}

}  // namespace warmjoint::report
