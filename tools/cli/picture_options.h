// How `plot` is told to draw: format, look, size, and which figures.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "tools/cli/plot_sources.h"
#include "tools/report/draw/figure.h"
#include "tools/report/draw/page_setting.h"

namespace warmjoint::inline tools {

/// The options as given.
struct PictureArguments {
  std::string format = "png";
  std::string style = "screen";
  std::string size;
  double dpi = 0;  // 0: the style's
  std::string title = "shown";
  std::vector<std::string> figures;
};

/// Adds --format, --style, --size, --dpi, --title and --figure.
void AddPictureOptions(CLI::App& parser, PictureArguments& arguments);

/// What the options ask for. Throws BadInput for a size that is none.
report::PageSetting SettingOf(const PictureArguments& arguments);

/// Leaves the figures that --figure names, by name or by the number that the paper gives them; all
/// without it. source: what they are of. Throws BadInput where one of them is not among them, and says
/// what it needs.
std::vector<report::Figure> Chosen(const PictureArguments& arguments, const std::string& source,
                                   const SourcePictures& pictures);

}  // namespace warmjoint::inline tools
