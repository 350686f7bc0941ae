// Colours and sizes of all pictures.
#pragma once

#include <string>
#include <string_view>

#include "tools/report/gl/image.h"

namespace warmjoint::report {

/// Colours by role. Blue to sky are the palette of Okabe and Ito (2008), which colour-blind readers
/// tell apart; caution is for words alone. A theme says how each looks.
enum class Hue { text, grey, blue, vermilion, green, purple, orange, sky, caution };

struct Theme {
  std::string_view name;
  Rgb background;
  Rgb text;
  Rgb faint_text;  // tick labels, notes
  Rgb axis;
  Rgb grid;
  Rgb minor_grid;
  Rgb hues[9];  // by Hue

  Rgb Colour(Hue hue) const { return hues[static_cast<int>(hue)]; }
};

const Theme& LightTheme();
const Theme& DarkTheme();
/// Light, with words and axes in black: for print.
const Theme& PaperTheme();

/// The hue of an identifier, the same in every figure: fixed for those that come with the program.
Hue IdentifierHue(const std::string& identifier);

/// Sizes in points.
namespace size {
inline constexpr double kTitle = 16;
inline constexpr double kText = 12;
inline constexpr double kTick = 11;
inline constexpr double kPad = 6;         // between neighbouring things
inline constexpr double kMargin = 16;     // around the figure
inline constexpr double kGap = 20;        // between panels
inline constexpr double kTickMark = 4;    // length
inline constexpr double kLegendKey = 20;  // length of the sample in a legend
inline constexpr double kColourBar = 12;  // width
}  // namespace size

}  // namespace warmjoint::report
