// Axes, legend and series of one plot.
#pragma once

#include "tools/report/draw/figure.h"
#include "tools/report/draw/pen.h"

namespace warmjoint::report {

/// Throws BadInput for an axis without extent or a logarithmic one that reaches 0.
void CheckAxes(const Plot& plot);

/// Room that a plot needs around its axes, points.
struct Margins {
  float left = 0, right = 0, bottom = 0;
};

/// Room for tick labels, axis labels and colour bar of a plot about `extent` wide and high.
Margins PlotMargins(const Pen& pen, const Plot& plot, ImVec2 extent);

/// Height of the legend when it may be `width` wide; 0 where no series has a label.
float LegendHeight(const Pen& pen, const Plot& plot, float width);

/// Draws the legend with its upper left corner at `at`.
void DrawLegend(Pen& pen, const Plot& plot, ImVec2 at, float width);

/// Draws axes and series; `area` is the rectangle between the axes. label_x: middle of the name of
/// the upright axis. number: makes names unique.
void DrawPlot(Pen& pen, const std::string& title, const Plot& plot, const Rectangle& area,
              float label_x, int number);

}  // namespace warmjoint::report
