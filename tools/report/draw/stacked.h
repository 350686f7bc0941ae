// Figures of several columns on narrow pages.
#pragma once

#include "tools/report/draw/figure.h"

namespace warmjoint::report {

/// The figure as it is where each of its plots is wide enough to be read; else its panels one under the
/// other, row after row, with the height that they need (Figure::height 0). head: points that the figure
/// keeps above its panels.
Figure Stacked(Figure figure, double head);

}  // namespace warmjoint::report
