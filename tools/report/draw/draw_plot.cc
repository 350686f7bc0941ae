#include "tools/report/draw/draw_plot.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "models/foundation/bad_input.h"
#include "tools/report/draw/draw_series.h"
#include "tools/report/draw/frame.h"
#include "tools/report/draw/ticks.h"

namespace warmjoint::report {
namespace {

// height of a plot, over what it is taken to be before its margins are known
constexpr double kHigher = 1.3;

constexpr Type kTickType{size::kTick};
constexpr Type kLabelType{size::kText};
constexpr double kPointsPerTickX = 45, kPointsPerTickY = 18;
constexpr double kBetweenLabels = 18;  // points that the labels of ticks stay apart

/// Whether the ticks' labels leave room between them on an axis of `width` points.
bool LabelsFit(const Axis& axis, const std::vector<Tick>& ticks, double width) {
  for (std::size_t i = 1; i < ticks.size(); ++i) {
    const double words =
        (Measure(ticks[i - 1].label, kTickType).width + Measure(ticks[i].label, kTickType).width) /
        2;
    const double apart = ShareOf(axis, ticks[i].value) - ShareOf(axis, ticks[i - 1].value);
    if (width * apart < words + kBetweenLabels) return false;
  }
  return true;
}

/// As many ticks as their labels leave room for.
std::vector<Tick> TicksX(const Axis& axis, double width) {
  int wanted = static_cast<int>(width / kPointsPerTickX);
  while (wanted > 1 && !LabelsFit(axis, AxisTicks(axis, wanted), width)) --wanted;
  return AxisTicks(axis, wanted);
}

std::vector<Tick> TicksY(const Axis& axis, double height) {
  return AxisTicks(axis, static_cast<int>(height / kPointsPerTickY));
}

/// Width at which the labels of categories break; 0 for numbers, which never do.
double LabelWrap(const Axis& axis, double width) {
  return axis.ticks.empty() ? 0 : width / static_cast<double>(axis.ticks.size()) - 6;
}

double WidestLabel(const std::vector<Tick>& ticks) {
  double widest = 0;
  for (const Tick& tick : ticks) widest = std::max(widest, Measure(tick.label, kTickType).width);
  return widest;
}

const HeatMap* FindHeatMap(const Plot& plot) {
  for (const Series& series : plot.series) {
    if (const auto* map = std::get_if<HeatMap>(&series.shape)) return map;
  }
  return nullptr;
}

Axis ColourAxis(const HeatMap& map) {
  return {map.label, map.colours.first, map.colours.second, Scale::linear, {}};
}

void CheckAxis(const Axis& axis) {
  const bool has_extent =
      std::isfinite(axis.lower) && std::isfinite(axis.upper) && axis.lower < axis.upper;
  if (!has_extent || (axis.scale == Scale::logarithmic && axis.lower <= 0)) {
    Refuse({}, "axis '{}' cannot run from {} to {}{}", axis.label, axis.lower, axis.upper,
           axis.scale == Scale::logarithmic ? ": logarithmic axes start above 0" : "");
  }
}

/// Grid behind the data.
void DrawGrid(Pen& pen, const Plot& plot, const Frame& frame) {
  const Rectangle& area = frame.area();
  // a line of the grid at a value of either axis
  const auto across = [&](double y, Rgb colour) {
    pen.canvas().Stroke({area.left, frame.Y(y)}, {area.right, frame.Y(y)}, colour, 1);
  };
  const auto upright = [&](double x, Rgb colour) {
    pen.canvas().Stroke({frame.X(x), area.top}, {frame.X(x), area.bottom}, colour, 1);
  };
  // minor lines first, so that the others lie over them
  for (double x : MinorTicks(plot.x)) upright(x, pen.theme().minor_grid);
  for (double y : MinorTicks(plot.y)) across(y, pen.theme().minor_grid);
  // categories have labels of their own and need no lines
  if (plot.x.ticks.empty()) {
    for (const Tick& tick : TicksX(plot.x, area.width())) upright(tick.value, pen.theme().grid);
  }
  // ticks without a label have no line
  for (const Tick& tick : TicksY(plot.y, area.height())) {
    if (!tick.label.empty()) across(tick.value, pen.theme().grid);
  }
}

/// Marks and labels below the plot; returns y below them.
double DrawTicksX(Pen& pen, const Plot& plot, const Frame& frame) {
  const Rectangle& area = frame.area();
  double lowest = area.bottom;
  const double wrap = LabelWrap(plot.x, area.width());
  for (const Tick& tick : TicksX(plot.x, area.width())) {
    if (tick.label.empty()) continue;
    // a mark, with its label centred below
    const double x = frame.X(tick.value);
    pen.canvas().Stroke({x, area.bottom}, {x, area.bottom + size::kTickMark}, pen.theme().axis, 1);
    const double top = area.bottom + size::kTickMark + 2;
    const Extent extent =
        pen.WriteCentred(tick.label, kTickType, {x, top}, pen.theme().faint_text, wrap);
    // the tallest label says where the name of the axis may stand
    lowest = std::max(lowest, top + extent.height);
  }
  return lowest;
}

/// Marks and labels beside the plot.
void DrawTicksY(Pen& pen, const Plot& plot, const Frame& frame) {
  const Rectangle& area = frame.area();
  for (const Tick& tick : TicksY(plot.y, area.height())) {
    if (tick.label.empty()) continue;
    // a mark, with its label beside it at the same height
    const double y = frame.Y(tick.value);
    pen.canvas().Stroke({area.left - size::kTickMark, y}, {area.left, y}, pen.theme().axis, 1);
    const Extent extent = Measure(tick.label, kTickType);
    pen.Write(tick.label, kTickType,
              {area.left - size::kTickMark - 3 - extent.width, y - extent.height / 2},
              pen.theme().faint_text);
  }
}

/// Axis lines, ticks, their labels and the names of the axes.
void DrawAxes(Pen& pen, const Plot& plot, const Frame& frame, double label_x) {
  const Rectangle& area = frame.area();
  // the two axes meet at the lower left
  pen.canvas().Stroke({area.left, area.top}, {area.left, area.bottom}, pen.theme().axis, 1);
  pen.canvas().Stroke({area.left, area.bottom}, {area.right, area.bottom}, pen.theme().axis, 1);
  // ticks first: their labels say where the name of x stands
  const double lowest = DrawTicksX(pen, plot, frame);
  DrawTicksY(pen, plot, frame);
  if (!plot.x.label.empty()) {
    const double width = Measure(plot.x.label, kLabelType).width;
    pen.Write(plot.x.label, kLabelType, {(area.left + area.right - width) / 2, lowest + 3},
              pen.theme().text);
  }
  // the name of y runs upwards beside its axis
  if (!plot.y.label.empty()) {
    pen.WriteUpwards(plot.y.label, kLabelType, {label_x, (area.top + area.bottom) / 2},
                     pen.theme().text);
  }
}

void DrawColourBar(Pen& pen, const HeatMap& map, const Rectangle& area) {
  // the bar stands beside the plot, its lowest colour at the foot
  const Rectangle bar{area.right + 10, area.top, area.right + 10 + size::kColourBar, area.bottom};
  pen.canvas().Paint(bar, [&](Point p) -> std::optional<Rgb> {
    return HeatColour((bar.bottom - p.y) / bar.height());
  });
  // ticks at the right of the bar
  const Axis axis = ColourAxis(map);
  const std::vector<Tick> ticks = TicksY(axis, area.height());
  for (const Tick& tick : ticks) {
    const double y = area.bottom - area.height() * ShareOf(axis, tick.value);
    pen.canvas().Stroke({bar.right, y}, {bar.right + 3, y}, pen.theme().axis, 1);
    pen.Write(tick.label, kTickType, {bar.right + 6, y - Measure(tick.label, kTickType).height / 2},
              pen.theme().faint_text);
  }
  // the name of the colours runs upwards behind the widest label
  const double beside = bar.right + 6 + WidestLabel(ticks) + size::kPad + kLabelType.size / 2;
  pen.WriteUpwards(map.label, kLabelType, {beside, (area.top + area.bottom) / 2}, pen.theme().text);
}

}  // namespace

void CheckAxes(const Plot& plot) {
  CheckAxis(plot.x);
  CheckAxis(plot.y);
}

Margins PlotMargins(const Plot& plot, Extent extent) {
  const std::vector<Tick> across = TicksX(plot.x, extent.width);
  Margins margins;
  // a plot that comes out higher may have finer ticks, with longer labels
  const double labels_left = std::max(WidestLabel(TicksY(plot.y, extent.height)),
                                      WidestLabel(TicksY(plot.y, kHigher * extent.height)));
  margins.left = size::kTickMark + 3 + labels_left + size::kPad + kLabelType.size + 4;
  margins.right = 4;
  // the last label may stand half outside
  if (!across.empty() && plot.x.ticks.empty()) {
    margins.right = std::max(4.0, Measure(across.back().label, kTickType).width / 2);
  }
  // a colour bar needs room for its ticks and its name
  if (const HeatMap* map = FindHeatMap(plot)) {
    const double labels = WidestLabel(TicksY(ColourAxis(*map), extent.height));
    margins.right = 10 + size::kColourBar + 6 + labels + size::kPad + kLabelType.size + 4;
  }
  // labels of categories may take several lines
  double tallest = 0;
  for (const Tick& tick : across) {
    const double wrap = LabelWrap(plot.x, extent.width);
    tallest = std::max(tallest, Measure(tick.label, kTickType, wrap).height);
  }
  margins.bottom = size::kTickMark + 2 + tallest + 3 + kLabelType.size;
  return margins;
}

void DrawPlot(Pen& pen, const std::string& title, const Plot& plot, const Rectangle& area,
              double label_x) {
  const Frame frame(plot, area);
  DrawnPlot drawn{title, area, {plot.x.lower, plot.x.upper}, {plot.y.lower, plot.y.upper}, {}};
  // the data over the grid, cut at the edge of the plot
  DrawGrid(pen, plot, frame);
  pen.canvas().Clip(area);
  for (const Series& series : plot.series) {
    drawn.series.push_back(DrawSeries(pen, plot, series, frame));
  }
  pen.canvas().Unclip();
  // axes last, so that no marker covers them
  DrawAxes(pen, plot, frame, label_x);
  if (const HeatMap* map = FindHeatMap(plot)) DrawColourBar(pen, *map, area);
  pen.drawn().plots.push_back(std::move(drawn));
}

}  // namespace warmjoint::report
