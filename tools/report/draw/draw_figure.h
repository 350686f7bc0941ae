// From a figure to a picture.
#pragma once

#include <string>

#include "tools/report/draw/drawn.h"
#include "tools/report/draw/figure.h"
#include "tools/report/draw/page_setting.h"

namespace warmjoint::report {

/// Pixels of a picture drawn by DrawFigure, for each point of its figure.
inline constexpr int kPixelsPerPoint = 2;

/// Draws a figure as pixels, and says what it drew. The same figure and theme give the same bytes.
/// Throws BadInput for an axis without extent or a logarithmic one that reaches 0.
Drawn DrawFigure(const Figure& figure, const Theme& theme = LightTheme());

/// A picture file and what stands below it.
struct PictureFile {
  std::string bytes;
  std::string caption;  // the figure's finding, and how it is thinned; the file holds it, too
  double width = 0;     // points
  double height = 0;
};

/// The figure as a file. The same figure and setting give the same bytes.
/// Throws BadInput as DrawFigure does, and where the page is too small for the figure.
PictureFile EncodeFigure(const Figure& figure, const PageSetting& setting = {});

}  // namespace warmjoint::report
