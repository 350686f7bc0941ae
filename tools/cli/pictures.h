// What `plot` draws: the pictures of each kind of source, their format and look, and which of them.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/cli/backend.h"
#include "tools/cli/recording_options.h"
#include "tools/figures/estimate_view.h"
#include "tools/figures/figure.h"

namespace warmjoint {

/// The name by which `plot` draws the figure of normalised and plain kernels.
inline constexpr const char* kKernelsSource = "kernels";

/// The pictures of one source.
struct SourcePictures {
  std::vector<figures::Figure> figures;
  /// Figures that this source does not give, and what they need.
  std::vector<std::pair<std::string, std::string>> left_out;
  std::optional<figures::EstimateView> estimate = std::nullopt;
  std::vector<std::filesystem::path> recordings{};  // that were read for them
};

/// A directory of `run` or `simulate`, an estimate file, or `kernels`. recording: in place of the
/// one that an estimate file remembers, where given. Says on stderr what cannot be drawn.
/// Throws BadInput.
SourcePictures PicturesOf(const std::string& source, const RecordingSource& recording);

/// The options as given.
struct PictureArguments {
  PictureSetting setting;  // but for width and height
  std::string size;
  std::vector<std::string> figures;
};

/// Adds --format, --style, --size, --dpi, --title and --figure.
void AddPictureOptions(CLI::App& parser, PictureArguments& arguments);

/// What the options ask for. Throws BadInput for a size that is none.
PictureSetting SettingOf(const PictureArguments& arguments);

/// Leaves the figures that --figure names, by name or by the number that the paper gives them; all
/// without it. source: what they are of. Throws BadInput where one of them is not among them, and says
/// what it needs.
std::vector<figures::Figure> Chosen(const PictureArguments& arguments, const std::string& source,
                                    const SourcePictures& pictures);

}  // namespace warmjoint
