// Words and rectangles on the page, remembered as they are drawn.
#pragma once

#include <string>

#include "tools/report/draw/canvas.h"
#include "tools/report/draw/drawn.h"

namespace warmjoint::report {

class Pen {
 public:
  Pen(Canvas& canvas, const Theme& theme, Drawn& drawn)
      : canvas_(canvas), theme_(theme), drawn_(drawn) {}

  Canvas& canvas() { return canvas_; }
  const Theme& theme() const { return theme_; }
  Drawn& drawn() { return drawn_; }

  /// Words with their upper left corner at `at`. wrap: width at which lines break, 0: never.
  /// Returns their size.
  Extent Write(const std::string& text, const Type& type, Point at, Rgb colour, double wrap = 0);
  /// Lines of words, each centred about the upright through `top`. Returns their size.
  Extent WriteCentred(const std::string& text, const Type& type, Point top, Rgb colour,
                      double wrap = 0);
  /// Words centred at `middle`, running upwards.
  void WriteUpwards(const std::string& text, const Type& type, Point middle, Rgb colour);

 private:
  void Remember(const std::string& text, const Type& type, const Rectangle& place);

  Canvas& canvas_;
  const Theme& theme_;
  Drawn& drawn_;
};

}  // namespace warmjoint::report
