// Colours and sizes of all pictures.
#pragma once

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

/// The hue of an identifier, the same in every figure: fixed for those that come with the program.
Hue IdentifierHue(std::string_view identifier);

/// Sizes in points (1/2 pixel of the picture).
namespace size {
inline constexpr float kTitle = 16;
inline constexpr float kText = 12;
inline constexpr float kTick = 11;
inline constexpr float kPad = 6;         // between neighbouring things
inline constexpr float kMargin = 16;     // around the figure
inline constexpr float kGap = 20;        // between panels
inline constexpr float kTickMark = 4;    // length
inline constexpr float kLegendKey = 20;  // length of the sample in a legend
inline constexpr float kColourBar = 12;  // width
}  // namespace size

}  // namespace warmjoint::report
