// Identifiers in any language: a command that reads a recording and writes an estimate.
#pragma once

#include <string>

#include "tools/suite/prepared_identifier.h"

namespace warmjoint::inline tools {

/// Name under which suites list such an identifier. Its options: command, time_limit (s).
inline constexpr const char* kExternal = "external";

/// Whether a `--identifier` is of the form name=command with {recording} or {recording.h5}.
bool IsExternal(const std::string& argument);

/// The suite's entry for name=command. Files that the command names relative to the current
/// directory are made absolute, for it runs in one of its own.
SuiteIdentifier ReadExternal(const std::string& argument);

/// Runs the command in a fresh directory that holds the measurements alone: {recording} stands for
/// recording.csv, {recording.h5} for HDF5, {estimate} for the estimate.json to write. A command
/// that fails, takes too long or writes something else throws NoAnswer: crashed, timeout,
/// bad_answer.
PreparedIdentifier PrepareExternal(const SuiteIdentifier& identifier, const Place& place);

}  // namespace warmjoint::inline tools
