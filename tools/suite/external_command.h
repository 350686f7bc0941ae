// Commands that are identifiers: how they are named, and which files they may read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "identification/options.h"
#include "models/foundation/bad_input.h"
#include "scenarios/suite_identifier.h"

namespace warmjoint::inline tools {

/// The options of an entry that a suite holds under the name kExternal: command, shell, time_limit (s),
/// memory (MiB of each process), reads (more files and folders), beside (whether it reads what lies
/// beside the first file that it names).
const std::vector<OptionInfo>& ExternalOptions();

/// Whether a text stands in a command, as the placeholders do.
bool Mentions(const std::string& command, const std::string& text);

/// Whether a `--identifier` is of the form name=command with {recording} or {recording.h5}.
bool IsExternal(const std::string& argument);

/// How a command is read: as words that are its arguments, or as a line for a shell.
enum class CommandForm { words, shell };

/// The suite's entry for name=command. Files that the command names relative to the current
/// directory are made absolute, for it runs in one of its own. Throws BadInput where the name or a
/// placeholder is missing.
SuiteIdentifier ReadExternal(const std::string& argument, CommandForm form);

/// A suite's entry with the files that its command names made absolute, seen from the suite's folder;
/// other entries as they are. Where its first file then lies in a folder around the suite, which tells
/// the truth, it gets `beside: no`. suite: the file, for messages as well.
SuiteIdentifier WithFilesOfSuite(SuiteIdentifier identifier, const std::filesystem::path& suite);

/// Whether a suite's entry is a line for a shell.
bool NeedsShell(const SuiteIdentifier& identifier);

/// Files and folders, besides the system's, that the wall leaves open to the command: those that it
/// names, what lies beside the first unless the current folder lies in there, its interpreter's
/// libraries, and those of the option `reads`.
std::vector<std::filesystem::path> ReadableBy(const SuiteIdentifier& identifier);

}  // namespace warmjoint::inline tools
