#include "tools/report/draw/draw_plot.h"

#include <fmt/core.h>
#include <implot.h>

#include <algorithm>
#include <cmath>

#include "models/foundation/bad_input.h"
#include "tools/report/draw/draw_series.h"
#include "tools/report/draw/strokes.h"
#include "tools/report/draw/ticks.h"

namespace warmjoint::report {
namespace {

constexpr Type kTickType{size::kTick};
constexpr Type kLabelType{size::kText};
constexpr float kPointsPerTickX = 45, kPointsPerTickY = 26;
constexpr float kBetweenLabels = 18;  // points that the labels of ticks stay apart

/// Whether the ticks' labels leave room between them on an axis of `width` points.
bool LabelsFit(const Pen& pen, const Axis& axis, const std::vector<Tick>& ticks, float width) {
  const auto place = [&](double value) {
    const double share = axis.scale == Scale::linear
                             ? (value - axis.lower) / (axis.upper - axis.lower)
                             : std::log(value / axis.lower) / std::log(axis.upper / axis.lower);
    return width * static_cast<float>(share);
  };
  for (std::size_t i = 1; i < ticks.size(); ++i) {
    const float words =
        (pen.Measure(ticks[i - 1].label, kTickType).x + pen.Measure(ticks[i].label, kTickType).x) /
        2;
    if (place(ticks[i].value) - place(ticks[i - 1].value) < words + kBetweenLabels) return false;
  }
  return true;
}

/// As many ticks as their labels leave room for.
std::vector<Tick> TicksX(const Pen& pen, const Axis& axis, float width) {
  int wanted = static_cast<int>(width / kPointsPerTickX);
  while (wanted > 1 && !LabelsFit(pen, axis, AxisTicks(axis, wanted), width)) --wanted;
  return AxisTicks(axis, wanted);
}

std::vector<Tick> TicksY(const Axis& axis, float height) {
  return AxisTicks(axis, static_cast<int>(height / kPointsPerTickY));
}

/// Width at which the labels of categories break; 0 for numbers, which never do.
float LabelWrap(const Axis& axis, float width) {
  return axis.ticks.empty() ? 0 : width / static_cast<float>(axis.ticks.size()) - 6;
}

float WidestLabel(const Pen& pen, const std::vector<Tick>& ticks) {
  float widest = 0;
  for (const Tick& tick : ticks) widest = std::max(widest, pen.Measure(tick.label, kTickType).x);
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

void SetUpAxis(ImAxis which, const Axis& axis) {
  ImPlot::SetupAxis(which, nullptr, ImPlotAxisFlags_NoDecorations | ImPlotAxisFlags_NoHighlight);
  if (axis.scale == Scale::logarithmic) ImPlot::SetupAxisScale(which, ImPlotScale_Log10);
  ImPlot::SetupAxisLimits(which, axis.lower, axis.upper, ImPlotCond_Always);
}

/// Grid behind the data.
void DrawGrid(Pen& pen, const Plot& plot, const Rectangle& area) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const auto across = [&](double y, Rgb colour) {
    const float at = ImPlot::PlotToPixels(plot.x.lower, y).y;
    StrokeLine(list, {area.left, at}, {area.right, at}, Pen::Paint(colour), 1);
  };
  const auto upright = [&](double x, Rgb colour) {
    const float at = ImPlot::PlotToPixels(x, plot.y.lower).x;
    StrokeLine(list, {at, area.top}, {at, area.bottom}, Pen::Paint(colour), 1);
  };
  for (double x : MinorTicks(plot.x)) upright(x, pen.theme().minor_grid);
  for (double y : MinorTicks(plot.y)) across(y, pen.theme().minor_grid);
  // categories have labels of their own and need no lines
  if (plot.x.ticks.empty()) {
    for (const Tick& tick : TicksX(pen, plot.x, area.width()))
      upright(tick.value, pen.theme().grid);
  }
  for (const Tick& tick : TicksY(plot.y, area.height())) {
    if (!tick.label.empty()) across(tick.value, pen.theme().grid);
  }
}

/// Axis lines, ticks, their labels and the names of the axes.
void DrawAxes(Pen& pen, const Plot& plot, const Rectangle& area, float label_x) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 paint = Pen::Paint(pen.theme().axis);
  StrokeLine(list, {area.left, area.top}, {area.left, area.bottom}, paint, 1);
  StrokeLine(list, {area.left, area.bottom}, {area.right, area.bottom}, paint, 1);

  float lowest = area.bottom;
  const float wrap = LabelWrap(plot.x, area.width());
  for (const Tick& tick : TicksX(pen, plot.x, area.width())) {
    if (tick.label.empty()) continue;
    const float x = ImPlot::PlotToPixels(tick.value, plot.y.lower).x;
    StrokeLine(list, {x, area.bottom}, {x, area.bottom + size::kTickMark}, paint, 1);
    const float top = area.bottom + size::kTickMark + 2;
    const ImVec2 extent =
        pen.WriteCentred(list, tick.label, kTickType, {x, top}, pen.theme().faint_text, wrap);
    lowest = std::max(lowest, top + extent.y);
  }
  const std::vector<Tick> ticks = TicksY(plot.y, area.height());
  for (const Tick& tick : ticks) {
    if (tick.label.empty()) continue;
    const float y = ImPlot::PlotToPixels(plot.x.lower, tick.value).y;
    StrokeLine(list, {area.left - size::kTickMark, y}, {area.left, y}, paint, 1);
    const ImVec2 extent = pen.Measure(tick.label, kTickType);
    pen.Write(list, tick.label, kTickType,
              {area.left - size::kTickMark - 3 - extent.x, y - extent.y / 2},
              pen.theme().faint_text);
  }

  const ImVec2 name = pen.Measure(plot.x.label, kLabelType);
  if (!plot.x.label.empty())
    pen.Write(list, plot.x.label, kLabelType, {(area.left + area.right - name.x) / 2, lowest + 3},
              pen.theme().text);
  pen.WriteUpwards(list, plot.y.label, kLabelType, {label_x, (area.top + area.bottom) / 2},
                   pen.theme().text);
}

void DrawColourBar(Pen& pen, const HeatMap& map, const Rectangle& area) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float left = area.right + 10, right = left + size::kColourBar;
  const int steps = 128;
  for (int i = 0; i < steps; ++i) {
    const float top = area.bottom - area.height() * static_cast<float>(i + 1) / steps;
    const float bottom = area.bottom - area.height() * static_cast<float>(i) / steps;
    list.AddRectFilled({left, top}, {right, bottom}, Pen::Paint(HeatColour((i + 0.5) / steps)));
  }
  const Axis axis = ColourAxis(map);
  const std::vector<Tick> ticks = TicksY(axis, area.height());
  for (const Tick& tick : ticks) {
    const double share = (tick.value - axis.lower) / (axis.upper - axis.lower);
    const float y = area.bottom - area.height() * static_cast<float>(share);
    StrokeLine(list, {right, y}, {right + 3, y}, Pen::Paint(pen.theme().axis), 1);
    pen.Write(list, tick.label, kTickType,
              {right + 6, y - pen.Measure(tick.label, kTickType).y / 2}, pen.theme().faint_text);
  }
  const float beside = right + 6 + WidestLabel(pen, ticks) + size::kPad + kLabelType.size / 2;
  pen.WriteUpwards(list, map.label, kLabelType, {beside, (area.top + area.bottom) / 2},
                   pen.theme().text);
}

}  // namespace

void CheckAxes(const Plot& plot) {
  CheckAxis(plot.x);
  CheckAxis(plot.y);
}

Margins PlotMargins(const Pen& pen, const Plot& plot, ImVec2 extent) {
  const std::vector<Tick> across = TicksX(pen, plot.x, extent.x);
  Margins margins;
  margins.left = size::kTickMark + 3 + WidestLabel(pen, TicksY(plot.y, extent.y)) + size::kPad +
                 kLabelType.size + 4;
  margins.right = 4;
  // the last label may stand half outside
  if (!across.empty() && plot.x.ticks.empty()) {
    margins.right = std::max(4.0f, pen.Measure(across.back().label, kTickType).x / 2);
  }
  if (const HeatMap* map = FindHeatMap(plot)) {
    const float labels = WidestLabel(pen, TicksY(ColourAxis(*map), extent.y));
    margins.right = 10 + size::kColourBar + 6 + labels + size::kPad + kLabelType.size + 4;
  }
  float tallest = 0;
  for (const Tick& tick : across) {
    const float wrap = LabelWrap(plot.x, extent.x);
    tallest = std::max(tallest, pen.Measure(tick.label, kTickType, wrap).y);
  }
  margins.bottom = size::kTickMark + 2 + tallest + 3 + pen.Measure("x", kLabelType).y;
  return margins;
}

void DrawPlot(Pen& pen, const std::string& title, const Plot& plot, const Rectangle& area,
              float label_x, int number) {
  ImPlotStyle& style = ImPlot::GetStyle();
  style.PlotPadding = {0, 0};
  style.PlotMinSize = {10, 10};
  style.PlotBorderSize = 0;
  style.Colors[ImPlotCol_PlotBg] = style.Colors[ImPlotCol_FrameBg] = {0, 0, 0, 0};

  ImGui::SetCursorScreenPos({area.left, area.top});
  ImPlot::BeginPlot(fmt::format("##{}", number).c_str(), {area.width(), area.height()},
                    ImPlotFlags_CanvasOnly | ImPlotFlags_NoInputs | ImPlotFlags_NoFrame);
  SetUpAxis(ImAxis_X1, plot.x);
  SetUpAxis(ImAxis_Y1, plot.y);
  ImPlot::SetupFinish();

  const ImPlotRect limits = ImPlot::GetPlotLimits();
  const ImVec2 corner = ImPlot::GetPlotPos(), extent = ImPlot::GetPlotSize();
  DrawnPlot drawn{title,
                  {corner.x, corner.y, corner.x + extent.x, corner.y + extent.y},
                  {limits.X.Min, limits.X.Max},
                  {limits.Y.Min, limits.Y.Max},
                  {}};
  DrawGrid(pen, plot, area);
  for (const Series& series : plot.series) {
    drawn.series.push_back(DrawSeries(pen, plot, series, area));
  }
  DrawAxes(pen, plot, area, label_x);
  if (const HeatMap* map = FindHeatMap(plot)) DrawColourBar(pen, *map, area);
  ImPlot::EndPlot();
  pen.drawn().plots.push_back(std::move(drawn));
}

}  // namespace warmjoint::report
