// The typeface of the pictures: how much room words take, and whether it has their characters.
#pragma once

#include <string>
#include <vector>

#include "tools/report/draw/place.h"
#include "tools/report/draw/theme.h"

typedef struct _cairo_font_face cairo_font_face_t;

namespace warmjoint::report {

/// How words are set.
struct Type {
  double size = size::kText;  // of a line, points
  bool bold = false;
};

/// Part of a line that is set in one size: "k_{v}" is "k" and a lowered "v".
struct Run {
  std::string text;
  Type type;
  double left = 0;   // from the begin of the line, points
  double width = 0;  // points
  double drop = 0;   // below the line, points
};

/// The runs of a line; letters in "_{...}" are lowered.
std::vector<Run> RunsOf(const std::string& line, const Type& type);

/// The lines of a text: its own, broken between words where one is wider than `wrap`, or inside of a
/// word that alone is; wrap 0: its own alone.
std::vector<std::string> LinesOf(const std::string& text, const Type& type, double wrap = 0);

/// Width and height of a text, points.
Extent Measure(const std::string& text, const Type& type, double wrap = 0);

/// Whether the typeface has every character of the text, which must be UTF-8.
bool CanSet(const std::string& text, const Type& type);

/// From the top of a line to its baseline, points.
double BaselineOf(const Type& type);
/// Height of the letter M's square, as cairo and SVG count the size of a font, points.
double EmOf(const Type& type);

/// The typeface for cairo; lives as long as the program.
cairo_font_face_t* FaceOf(const Type& type);

/// Its name, for files that hold words as words.
inline constexpr const char* kTypefaceName = "DejaVu Sans";

}  // namespace warmjoint::report
