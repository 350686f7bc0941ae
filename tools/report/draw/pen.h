// Text and rectangles on the page, remembered as they are drawn.
#pragma once

#include <imgui.h>

#include "tools/report/draw/drawn.h"
#include "tools/report/gl/canvas.h"

namespace warmjoint::report {

/// How words are set.
struct Type {
  float size = size::kText;
  bool bold = false;
};

class Pen {
 public:
  Pen(const Brush& brush, const Theme& theme, Drawn& drawn)
      : brush_(brush), theme_(theme), drawn_(drawn) {}

  const Theme& theme() const { return theme_; }
  Drawn& drawn() { return drawn_; }

  static ImU32 Paint(Rgb colour, double opacity = 1);

  /// Width and height in points; wrap: width at which lines break, 0: never.
  ImVec2 Measure(const std::string& text, const Type& type, float wrap = 0) const;

  /// Words with their upper left corner at `at`. Returns their size.
  ImVec2 Write(ImDrawList& list, const std::string& text, const Type& type, ImVec2 at, Rgb colour,
               float wrap = 0);
  /// Lines of words, each centred about the upright through `top`. Returns their size.
  ImVec2 WriteCentred(ImDrawList& list, const std::string& text, const Type& type, ImVec2 top,
                      Rgb colour, float wrap = 0);
  /// Words centred at `middle`, running upwards.
  void WriteUpwards(ImDrawList& list, const std::string& text, const Type& type, ImVec2 middle,
                    Rgb colour);

 private:
  ImFont* Font(const Type& type) const { return type.bold ? brush_.bold : brush_.regular; }
  /// Remembers texts with a character that the typeface lacks: it shows as a replacement sign.
  void CheckGlyphs(const std::string& text, const Type& type);

  const Brush& brush_;
  const Theme& theme_;
  Drawn& drawn_;
};

}  // namespace warmjoint::report
