#include "tools/report/draw/page_setting.h"

#include <filesystem>
#include <stdexcept>

#include "models/foundation/bad_input.h"

namespace warmjoint::report {

const std::vector<Style>& Styles() {
  // two columns of a journal are 180 mm wide, its captions are of 8 points
  static const std::vector<Style> styles{
      {"screen", "words of 10 points, 144 pixels an inch", &LightTheme, 1, 0, 144},
      {"dark", "the same for dark screens", &DarkTheme, 1, 0, 144},
      {"paper", "180 mm wide, words of 8 points, black, 300 pixels an inch", &PaperTheme, 0.78, 180,
       300},
  };
  return styles;
}

const Style& StyleNamed(std::string_view name) {
  for (const Style& style : Styles()) {
    if (style.name == name) return style;
  }
  throw std::out_of_range(std::string(name));
}

std::string_view NameOf(FileFormat format) {
  switch (format) {
    case FileFormat::png:
      return "png";
    case FileFormat::svg:
      return "svg";
    case FileFormat::pdf:
      return "pdf";
  }
  return "";
}

FileFormat FormatOf(const std::string& path) {
  const std::string end = std::filesystem::path(path).extension().string();
  for (FileFormat format : {FileFormat::png, FileFormat::svg, FileFormat::pdf}) {
    if (end == "." + std::string(NameOf(format))) return format;
  }
  Refuse({path}, "pictures end in .png, .svg or .pdf, not in '{}'", end);
}

}  // namespace warmjoint::report
