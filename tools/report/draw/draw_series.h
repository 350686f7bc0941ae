// One series between the axes of a plot.
#pragma once

#include "tools/report/draw/figure.h"
#include "tools/report/draw/pen.h"

namespace warmjoint::report {

/// Draws a series in the plot that ImPlot has open, and says what it handed over.
/// area: of the plot, points.
DrawnSeries DrawSeries(Pen& pen, const Plot& plot, const Series& series, const Rectangle& area);

/// Colour of a value of a heat-map, from the scale viridis (van der Walt and Smith 2015), which
/// grows lighter all along; fraction: 0 ... 1 on its scale.
Rgb HeatColour(double fraction);

}  // namespace warmjoint::report
