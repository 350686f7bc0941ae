// What `plot` draws of each kind of source, and the format and look of its pictures.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "tools/cli/backend.h"
#include "tools/cli/recording_options.h"
#include "tools/shown/shown_data.h"
#include "tools/store/run_store.h"

namespace warmjoint {

/// The name by which `plot` draws the figure of normalised and plain kernels.
inline constexpr const char* kKernelsSource = "kernels";

/// A directory of `run` or `simulate`, an estimate file, or `kernels`, as the backend takes it: {kind, name, ...}.
struct PictureSource {
  Tree facts;
  std::vector<std::filesystem::path> recordings{};  // that were read for them
  std::shared_ptr<RunStore> store{};  // of a run, whose database is read until it is drawn
};

/// recording: in place of the one that an estimate file remembers, where given. Says on stderr what cannot be drawn.
/// Throws BadInput.
PictureSource SourceOf(const std::string& source, const RecordingSource& recording,
                       shown::ShownData& data);

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

}  // namespace warmjoint
