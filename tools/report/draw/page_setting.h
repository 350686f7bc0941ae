// How a figure becomes a page.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tools/report/draw/canvas.h"

namespace warmjoint::report {

/// A look: colours, sizes and fineness.
struct Style {
  std::string_view name;
  std::string_view summary;
  const Theme& (*theme)();
  double scale;  // points of the page for each of the figure: words of 12 points are 12 times that
  double width;  // mm; 0: as the figure has it
  double dpi;    // of pixels
};

/// The looks: "screen" first, "dark", "paper".
const std::vector<Style>& Styles();

/// The look of that name. Throws std::out_of_range where there is none.
const Style& StyleNamed(std::string_view name);

struct PageSetting {
  FileFormat format = FileFormat::png;
  Style style = Styles().front();
  double width = 0;   // mm; 0: the style's
  double height = 0;  // mm; 0: what the figure needs
  double dpi = 0;     // 0: the style's
  bool titled = true;
};

/// "png", "svg" or "pdf".
std::string_view NameOf(FileFormat format);

/// The format that the name of a file asks for by its end. Throws BadInput for any other.
FileFormat FormatOf(const std::string& path);

}  // namespace warmjoint::report
