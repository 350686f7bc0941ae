// A command of the user's in the place of an identifier, on one recording.
#pragma once

#include "tools/actions/identify_recording.h"
#include "tools/suite/external_command.h"
#include "tools/suite/prepared_identifier.h"

namespace warmjoint::inline tools {

/// A command that was checked: settings.identifier is name=command, settings.options are its own
/// (ExternalOptions), as time_limit.
struct CommandTask {
  SuiteIdentifier command;
  PreparedIdentifier ask;
};

/// Throws BadInput for a command without its placeholders, options that commands do not have, and
/// settings that only identifiers of the list know.
CommandTask CheckCommand(const IdentifySettings& settings);

/// Asks it as `run` does: behind the same wall, under the same limits, judged by the same table. Of an answer
/// that stands, the figures on what was held out come from a second answer, to the part before, or
/// are those of its friction along another recording. Throws NoAnswer where it gives none.
Estimate IdentifyByCommand(const CommandTask& task, const PreparedLog& log,
                           const HoldOutSource& holdout);

}  // namespace warmjoint::inline tools
