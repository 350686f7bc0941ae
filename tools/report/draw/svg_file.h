// What cairo leaves out of an SVG file: words as words, title and alt text, names that do not change.
#pragma once

#include <string>
#include <vector>

#include "tools/report/draw/canvas.h"

namespace warmjoint::report {

/// A line and where its baseline begins in the file.
struct SvgWords {
  TextLine line;
  double factor = 1;  // units of the file for each point of the figure
  double x = 0;
  double y = 0;
};

/// The file with all words on top of its drawing, title and description in front, and cairo's
/// numbers of surfaces, which count on in a process, counted from 1.
std::string CompleteSvg(const std::string& drawn, const std::vector<SvgWords>& words,
                        const Description& description);

}  // namespace warmjoint::report
