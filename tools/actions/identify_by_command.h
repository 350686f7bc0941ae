// A command of the user's in the place of an identifier, on one recording.
#pragma once

#include "tools/identify/identify_recording.h"
#include "tools/suite/external_identifier.h"

namespace warmjoint {

/// A command that was checked: settings.identifier is name=command, settings.options are its own, as time_limit.
struct CheckedCommand {
  SuiteIdentifier command;
  PreparedIdentifier ask;
};

/// Throws BadInput for a command without its placeholders, options that commands do not have, settings
/// that only identifiers of the list know, and a kernel without a sandbox where one is asked for.
CheckedCommand CheckCommand(const IdentifySettings& settings, Confinement confinement);

/// Asks it as `run` does: in the same sandbox, under the same limits, judged by the same table. Of an answer
/// that stands, the figures on what was held out come from a second answer, to the part before, or
/// are those of its friction along another recording. Throws NoAnswer where it gives none.
Estimate IdentifyByCommand(const CheckedCommand& task, const PreparedLog& log,
                           const HoldOutSource& holdout);

}  // namespace warmjoint
