// Identifiers in any language: a command that reads a recording and writes an estimate.
#pragma once

#include "identification/lack_of_fit/judging.h"
#include "models/foundation/bad_input.h"
#include "tools/suite/external_command.h"
#include "tools/suite/prepared_identifier.h"

namespace warmjoint::inline tools {

/// Runs the command in a fresh directory that holds the measurements alone, behind a wall that shows
/// no other of this program's files (wall.h), under limits (run_command.h): {recording} stands for
/// recording.csv, {recording.h5} for HDF5, {estimate} for the estimate.json to write. A command
/// that fails, takes too long or writes something else throws NoAnswer: crashed, timeout,
/// bad_answer. The answer is judged like those of our own identifiers (judge_estimate.h).
PreparedIdentifier PrepareExternal(const SuiteIdentifier& identifier, const Place& place,
                                   const Judging& judging = {});

}  // namespace warmjoint::inline tools
