// The options that say how a recording is to be read, shared by the subcommands that read one.
#pragma once

#include <warmjoint/prepared_log.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <vector>

#include "tools/identify/carried_heat.h"
#include "tools/identify/recording_source.h"

namespace warmjoint {

/// Adds RECORDING... and the options of AddLayoutOptions.
void AddRecordingOptions(CLI::App& parser, RecordingSource& source);

/// Adds --map, --unit, --scale, --columns, --rate, --wrap, --joint, --gear, --torque-constant and --no-project.
void AddLayoutOptions(CLI::App& parser, ReadSettings& settings);

/// Says on stderr what reading made of a log, a line each.
void TellNotes(const PreparedLog& log);

/// The files that reading a recording reads: its own, and the project file beside it.
std::vector<std::filesystem::path> InputsOf(const RecordingSource& source);

/// Adds --trim and --shortest-hold.
void AddHoldOptions(CLI::App& parser, PrepareSettings& holds);

/// Adds --follows and --pause.
void AddFollowOptions(CLI::App& parser, EarlierRecording& earlier);

/// Takes what the project file beside the recordings says where the command line does not
/// say it itself: single columns of map, unit and scale, and whole values of the others. Tells on
/// stderr, in a line, what it took, and puts it into arguments.project. Does nothing with --no-project,
/// or where no file is. parser: the subcommand's, after parsing. Throws BadInput as ParseProject does,
/// and for recordings that lie beside different files.
void TakeProject(const CLI::App& parser, RecordingSource& arguments);

}  // namespace warmjoint
