// Axes, legend and series of one plot.
#pragma once

#include "tools/report/draw/figure.h"
#include "tools/report/draw/pen.h"

namespace warmjoint::report {

/// Throws BadInput for an axis without extent or a logarithmic one that reaches 0.
void CheckAxes(const Plot& plot);

/// Room that a plot needs around its axes, points.
struct Margins {
  double left = 0, right = 0, bottom = 0;
};

/// Room for tick labels, axis labels and colour bar of a plot about `extent` wide and high.
Margins PlotMargins(const Plot& plot, Extent extent);

/// Height of the legend when it may be `width` wide; 0 where no series has a label.
double LegendHeight(const Plot& plot, double width);

/// Draws the legend with its upper left corner at `at`.
void DrawLegend(Pen& pen, const Plot& plot, Point at, double width);

/// Draws axes and series; `area` is the rectangle between the axes. label_x: middle of the name of
/// the upright axis.
void DrawPlot(Pen& pen, const std::string& title, const Plot& plot, const Rectangle& area,
              double label_x);

}  // namespace warmjoint::report
