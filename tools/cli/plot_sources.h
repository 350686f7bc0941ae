// What `plot` draws from, and the pictures of each kind of source.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/cli/recording_options.h"
#include "tools/report/draw/figure.h"
#include "tools/report/estimate/estimate_view.h"

namespace warmjoint::inline tools {

/// The name by which `plot` draws the figure of normalised and plain kernels.
inline constexpr const char* kKernelsSource = "kernels";

/// The pictures of one source.
struct SourcePictures {
  std::vector<report::Figure> figures;
  std::vector<report::Figure> film;  // frames; empty where there is none
  /// Figures that this source does not give, and what they need.
  std::vector<std::pair<std::string, std::string>> left_out;
  std::optional<report::EstimateView> estimate = std::nullopt;
  std::vector<std::filesystem::path> recordings{};  // that were read for them
};

/// A directory of `run` or `simulate`, an estimate file, or `kernels`. recording: in place of the
/// one that an estimate file remembers, where given. Says on stderr what cannot be drawn.
/// Throws BadInput.
SourcePictures PicturesOf(const std::string& source, const RecordingArguments& recording);

}  // namespace warmjoint::inline tools
