// Where the panels of a figure go.
#pragma once

#include <vector>

#include "tools/report/draw/figure.h"
#include "tools/report/draw/pen.h"

namespace warmjoint::report {

/// Rectangles of one panel, points.
struct PanelPlace {
  Rectangle cell;     // all of it
  float content = 0;  // y below title and legend
  Rectangle area;     // between the axes, for plots; else what lies below the title
};

/// One place for each panel. Plots of a column share their left and right edges, plots of a row
/// their upper and lower ones. top: y below the figure's title.
std::vector<PanelPlace> LayOut(const Pen& pen, const Figure& figure, float top);

}  // namespace warmjoint::report
