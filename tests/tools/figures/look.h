// How tests look at figures: what their plots hold, as data.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tools/figures/figure.h"

namespace warmjoint::figures {

/// A series with the range of its points that are known.
struct ShownSeries {
  std::string label;
  Hue hue = Hue::blue;
  Eigen::Index points = 0;
  std::pair<double, double> x{INFINITY, -INFINITY};
  std::pair<double, double> y{INFINITY, -INFINITY};
};

struct ShownPlot {
  std::string title;
  std::pair<double, double> x, y;  // limits of the axes
  std::vector<ShownSeries> series;
};

struct Shown {
  std::vector<ShownPlot> plots;
};

/// Takes in the values of one series; one function for each shape.
struct Taking {
  const Plot& plot;
  ShownSeries& shown;

  void operator()(const Line& line) { Both(line.x, line.y); }
  void operator()(const Scatter& scatter) { Both(scatter.x, scatter.y); }
  void operator()(const Bars& bars) { Both(bars.x, bars.height); }
  void operator()(const Band& band) {
    Both(band.x, band.lower);
    Both(band.x, band.upper);
  }
  void operator()(const Box& box) {
    for (double y : {box.lower, box.q25, box.median, box.q75, box.upper}) Point(box.x, y);
    for (double y : box.outliers) Point(box.x, y);
  }
  void operator()(const HeatMap& map) {
    Point(map.x.first, map.y.first);
    Point(map.x.second, map.y.second);
  }
  void operator()(const LevelLine& level) {
    for (double share : {0.0, 1.0}) {
      const double x = plot.x.lower + share * (plot.x.upper - plot.x.lower);
      const double y = plot.y.lower + share * (plot.y.upper - plot.y.lower);
      Point(level.vertical ? level.value : x, level.vertical ? y : level.value);
    }
  }
  void operator()(const Note& note) { Point(note.x, note.y); }

 private:
  void Both(const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
    ASSERT_EQ(x.size(), y.size());
    for (Eigen::Index i = 0; i < x.size(); ++i) Point(x[i], y[i]);
  }
  void Point(double x, double y) {
    if (!std::isfinite(x) || !std::isfinite(y)) return;
    ++shown.points;
    shown.x = {std::min(shown.x.first, x), std::max(shown.x.second, x)};
    shown.y = {std::min(shown.y.first, y), std::max(shown.y.second, y)};
  }
};

/// What the figure's plots show, after checks that hold for any figure: it says in words what one sees, its axes have an
/// extent, each plot has data within them, and what is written for the backend can be parsed.
inline Shown Look(const Figure& figure) {
  EXPECT_FALSE(figure.finding.empty()) << figure.name << " has no alt text";
  EXPECT_FALSE(FigureJson(figure).dump().empty());
  Shown shown;
  for (const Panel& panel : figure.panels) {
    EXPECT_LT(panel.row + panel.row_span - 1, static_cast<int>(figure.rows.size()));
    EXPECT_LT(panel.column + panel.column_span - 1, static_cast<int>(figure.columns.size()));
    const auto* plot = std::get_if<Plot>(&panel.content);
    if (!plot) continue;
    ShownPlot& one = shown.plots.emplace_back();
    one.title = panel.title;
    one.x = {plot->x.lower, plot->x.upper};
    one.y = {plot->y.lower, plot->y.upper};
    bool any = false;
    for (const Series& series : plot->series) {
      ShownSeries& own = one.series.emplace_back();
      own.label = series.label;
      own.hue = series.hue;
      std::visit(Taking{*plot, own}, series.shape);
      any = any || (own.points > 0 && own.x.first <= one.x.second && own.x.second >= one.x.first &&
                    own.y.first <= one.y.second && own.y.second >= one.y.first);
    }
    EXPECT_TRUE(any) << figure.name << ": '" << panel.title << "' shows no data";
    for (const Axis* axis : {&plot->x, &plot->y}) {
      EXPECT_TRUE(axis->lower < axis->upper) << figure.name << ": '" << axis->label << "'";
      EXPECT_TRUE(axis->scale == Scale::linear || axis->lower > 0) << axis->label;
    }
  }
  return shown;
}

/// What those figures of a family show that the view has data for, by their names, which are those of their files.
template <typename View>
std::map<std::string, Shown> LookAtAll(const std::vector<NamedFigure<View>>& family,
                                       const View& view) {
  std::map<std::string, Shown> shown;
  for (const NamedFigure<View>& one : family) {
    SCOPED_TRACE(one.name);
    EXPECT_FALSE(one.summary.empty());
    const std::optional<Figure> figure = one.make(view);
    if (!figure) continue;
    EXPECT_EQ(figure->name, one.name);
    EXPECT_TRUE(shown.emplace(one.name, Look(*figure)).second) << "taken";
  }
  return shown;
}

/// The plot of that title.
inline const ShownPlot& PlotNamed(const Shown& shown, const std::string& title) {
  for (const ShownPlot& plot : shown.plots) {
    if (plot.title == title) return plot;
  }
  ADD_FAILURE() << "no plot '" << title << "'";
  static const ShownPlot none;
  return none;
}

/// The series of that label.
inline const ShownSeries& SeriesNamed(const ShownPlot& plot, const std::string& label) {
  for (const ShownSeries& series : plot.series) {
    if (series.label == label) return series;
  }
  ADD_FAILURE() << "no series '" << label << "' in '" << plot.title << "'";
  static const ShownSeries none;
  return none;
}

}  // namespace warmjoint::figures
