// Identifiers in any language: a command that reads a recording and writes an estimate.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/suite/prepared_identifier.h"

namespace warmjoint::inline tools {

/// Name under which suites list such an identifier. Its options: command, shell (yes or no),
/// time_limit (s), memory (MiB of each process), reads (files and folders besides its own).
inline constexpr const char* kExternal = "external";

/// Whether a `--identifier` is of the form name=command with {recording} or {recording.h5}.
bool IsExternal(const std::string& argument);

/// How a command is read: as words that are its arguments, or as a line for a shell.
enum class CommandForm { words, shell };

/// The suite's entry for name=command. Files that the command names relative to the current
/// directory are made absolute, for it runs in one of its own.
SuiteIdentifier ReadExternal(const std::string& argument, CommandForm form);

/// Whether a suite's entry is a line for a shell.
bool NeedsShell(const SuiteIdentifier& identifier);

/// Files and folders, besides the system's, that the wall leaves open to the command: those that it
/// names, what lies beside the first, its interpreter's libraries, and those of the option `reads`.
std::vector<std::filesystem::path> ReadableBy(const SuiteIdentifier& identifier);

/// Runs the command in a fresh directory that holds the measurements alone, behind a wall that shows
/// no other of this program's files (wall.h), under limits (run_command.h): {recording} stands for
/// recording.csv, {recording.h5} for HDF5, {estimate} for the estimate.json to write. A command
/// that fails, takes too long or writes something else throws NoAnswer: crashed, timeout,
/// bad_answer. The answer is judged like those of our own identifiers (judge_estimate.h).
PreparedIdentifier PrepareExternal(const SuiteIdentifier& identifier, const Place& place);

}  // namespace warmjoint::inline tools
