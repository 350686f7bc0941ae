#include "tools/report/draw/layout.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "models/foundation/bad_input.h"
#include "tools/report/draw/draw_plot.h"
#include "tools/report/draw/draw_words.h"

namespace warmjoint::report {
namespace {

constexpr double kLeastWidth = 40, kLeastHeight = 30;  // points between the axes of a plot

/// Where a row or a column begins and ends.
using Track = std::pair<double, double>;

/// Tracks of these lengths with gaps between, from `begin`.
std::vector<Track> Tracks(const std::vector<double>& lengths, double begin) {
  std::vector<Track> tracks;
  double at = begin;
  for (double length : lengths) {
    tracks.emplace_back(at, at + length);
    at += length + size::kGap;
  }
  return tracks;
}

double Sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

double Gaps(const std::vector<double>& tracks) {
  return size::kGap * static_cast<double>(tracks.size() - 1);
}

std::vector<Track> Columns(const Figure& figure) {
  const double room = figure.width - 2 * size::kMargin - Gaps(figure.columns);
  std::vector<double> lengths;
  for (double share : figure.columns) lengths.push_back(room * share / Sum(figure.columns));
  return Tracks(lengths, size::kMargin);
}

double TitleHeight(const Panel& panel, double width) {
  if (panel.title.empty()) return 0;
  return Measure(panel.title, {size::kText, true}, width).height + 4;
}

/// What words and tables need; 0 for all else.
double HeightOfContent(const Panel& panel, double width) {
  if (const auto* words = std::get_if<Words>(&panel.content)) return HeightOf(*words, width);
  if (const auto* table = std::get_if<Table>(&panel.content)) return HeightOf(*table);
  return 0;
}

/// Heights of rows that are as high as their words need, by row.
std::map<int, double> HeightsOfWords(const Figure& figure) {
  const std::vector<Track> columns = Columns(figure);
  std::map<int, double> heights;
  for (const Panel& panel : figure.panels) {
    // only rows without a height of their own ask what their words need
    if (figure.rows[panel.row] != 0) continue;
    const double width =
        columns[panel.column + panel.column_span - 1].second - columns[panel.column].first;
    double& height = heights[panel.row];
    height = std::max(height, TitleHeight(panel, width) + HeightOfContent(panel, width));
  }
  return heights;
}

std::vector<Track> Rows(const Figure& figure, double top) {
  const std::map<int, double> words = HeightsOfWords(figure);
  double room = figure.height - top - size::kMargin - Gaps(figure.rows);
  for (const auto& [row, height] : words) room -= height;
  std::vector<double> lengths;
  for (double share : figure.rows) {
    const auto row = static_cast<int>(lengths.size());
    lengths.push_back(share == 0 ? words.at(row) : room * share / Sum(figure.rows));
  }
  return Tracks(lengths, top);
}

/// Keeps the largest value for each key.
void Widen(std::map<int, double>& widest, int key, double value) {
  widest[key] = std::max(widest[key], value);
}

}  // namespace

double NaturalHeight(const Figure& figure, double top) {
  double height = top + Sum(figure.rows) + Gaps(figure.rows) + size::kMargin;
  for (const auto& [row, words] : HeightsOfWords(figure)) height += words;
  return std::ceil(height);
}

std::vector<PanelPlace> LayOut(const Figure& figure, double top) {
  const std::vector<Track> columns = Columns(figure), rows = Rows(figure, top);

  std::vector<PanelPlace> places;
  std::map<int, double> left, right, upper, bottom;  // by first or last column or row
  for (const Panel& panel : figure.panels) {
    PanelPlace place;
    place.cell = {columns[panel.column].first, rows[panel.row].first,
                  columns[panel.column + panel.column_span - 1].second,
                  rows[panel.row + panel.row_span - 1].second};
    // a plot needs room for labels and legend, and the widest of a line decides for all in it
    double head = TitleHeight(panel, place.cell.width());
    if (const auto* plot = std::get_if<Plot>(&panel.content)) {
      const Margins margins =
          PlotMargins(*plot, {0.85 * place.cell.width(), 0.7 * place.cell.height()});
      const double legend = LegendHeight(*plot, place.cell.width());
      head += legend + (legend > 0 ? 4 : 2);
      Widen(left, panel.column, margins.left);
      Widen(right, panel.column + panel.column_span - 1, margins.right);
      Widen(bottom, panel.row + panel.row_span - 1, margins.bottom);
      Widen(upper, panel.row, head);
    }
    // words, tables and pictures have the whole cell below the title
    place.area = {place.cell.left, place.cell.top + head, place.cell.right, place.cell.bottom};
    places.push_back(place);
  }

  // plots in line with their neighbours, on whole points, so that axes are sharp
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Panel& panel = figure.panels[i];
    if (!std::holds_alternative<Plot>(panel.content)) continue;
    Rectangle& area = places[i].area;
    area = {std::round(area.left + left[panel.column]),
            std::round(places[i].cell.top + upper[panel.row]),
            std::round(area.right - right[panel.column + panel.column_span - 1]),
            std::round(area.bottom - bottom[panel.row + panel.row_span - 1])};
    // axes too small to be read are refused with what they lack
    if (area.width() < kLeastWidth || area.height() < kLeastHeight) {
      throw TooSmall(fmt::format(
          "'{}' is too small for '{}': {:.0f} x {:.0f} points are left between its axes, {:.0f} x "
          "{:.0f} are needed; give it more room",
          figure.name, panel.title, std::max(0.0, area.width()), std::max(0.0, area.height()),
          kLeastWidth, kLeastHeight));
    }
  }
  return places;
}

}  // namespace warmjoint::report
