// Where the panels of a figure go.
#pragma once

#include <vector>

#include "models/foundation/bad_input.h"
#include "tools/report/draw/figure.h"
#include "tools/report/draw/place.h"

namespace warmjoint::report {

/// A figure whose panels have no room at the size that is asked for.
class TooSmall : public BadInput {
 public:
  using BadInput::BadInput;
};

/// Rectangles of one panel, points.
struct PanelPlace {
  Rectangle cell;  // all of it
  Rectangle area;  // between the axes, for plots; else what lies below the title
};

/// Height of a figure whose rows have heights of their own, points. top: y below its title.
double NaturalHeight(const Figure& figure, double top);

/// One place for each panel. Plots of a column share their left and right edges, plots of a row
/// their upper and lower ones. Throws TooSmall where a plot would have no room.
std::vector<PanelPlace> LayOut(const Figure& figure, double top);

}  // namespace warmjoint::report
