// From a figure to pixels.
#pragma once

#include "tools/report/draw/drawn.h"
#include "tools/report/draw/figure.h"
#include "tools/report/gl/canvas.h"

namespace warmjoint::report {

/// Draws a figure. The same figure and theme give the same bytes.
/// Throws BadInput for an axis without extent or a logarithmic one that reaches 0.
Drawn DrawFigure(Canvas& canvas, const Figure& figure, const Theme& theme = LightTheme());

}  // namespace warmjoint::report
