// The project file beside a recording, taken as if its options stood on the command line.
#pragma once

#include <CLI/CLI.hpp>

#include "tools/actions/recording_source.h"

namespace warmjoint::inline tools {

/// Adds --no-project.
void AddProjectOption(CLI::App& parser);

/// Takes what the project file (project_file.h) beside the recordings says where the command line does not
/// say it itself: single columns of map, unit and scale, and whole values of the others. Tells on
/// stderr, in a line, what it took, and puts it into arguments.project. Does nothing with --no-project,
/// or where no file is. parser: the subcommand's, after parsing. Throws BadInput as ParseProject does,
/// and for recordings that lie beside different files.
void TakeProject(const CLI::App& parser, RecordingArguments& arguments);

}  // namespace warmjoint::inline tools
