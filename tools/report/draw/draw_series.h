// One series between the axes of a plot.
#pragma once

#include "tools/report/draw/figure.h"
#include "tools/report/draw/frame.h"
#include "tools/report/draw/pen.h"

namespace warmjoint::report {

/// Draws a series between the axes, and says what it drew.
DrawnSeries DrawSeries(Pen& pen, const Plot& plot, const Series& series, const Frame& frame);

/// Colour of a value of a heat-map, from the scale viridis (van der Walt and Smith 2015), which
/// grows lighter all along; fraction: 0 ... 1 on its scale.
Rgb HeatColour(double fraction);

}  // namespace warmjoint::report
