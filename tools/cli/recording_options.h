// The options that say how a recording is to be read, shared by the subcommands that read one.
#pragma once

#include <CLI/CLI.hpp>

#include "tools/actions/recording_source.h"

namespace warmjoint::inline tools {

/// Adds RECORDING... and the options of AddLayoutOptions.
void AddRecordingOptions(CLI::App& parser, RecordingArguments& arguments);

/// Adds --map, --unit, --scale, --wrap, --temperature, --joint, --gear, --torque-constant and --no-project.
void AddLayoutOptions(CLI::App& parser, RecordingArguments& arguments);

/// Adds --trim and --shortest-hold.
void AddHoldOptions(CLI::App& parser, HoldOptions& holds);

}  // namespace warmjoint::inline tools
