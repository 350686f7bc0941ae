// Identifiers in any language: a command that reads a recording and writes an estimate.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/suite.h>

#include <filesystem>
#include <string>
#include <vector>

#include "identification/lack_of_fit/find_lack_of_fit.h"
#include "models/foundation/bad_input.h"
#include "scenarios/suite.h"
#include "tools/identify/identify_recording.h"
#include "tools/suite/prepare_identifiers.h"
#include "tools/suite/sandbox.h"

namespace warmjoint {

/// The suite's entry for an argument name=command. Files that the command names relative to the current directory are
/// made absolute, for it runs in one of its own. Throws BadInput where the name or a placeholder is missing.
SuiteIdentifier ReadExternal(const std::string& argument);

/// A suite's entry with the files that its command names made absolute, seen from the suite's folder; other entries as
/// they are. Where its first file then lies in a folder around the suite, which tells the truth, it gets `beside: no`.
/// suite: the file, for messages as well.
SuiteIdentifier WithFilesOfSuite(SuiteIdentifier identifier, const std::filesystem::path& suite);

/// Files and folders, besides the system's, that the command may read: those that it names, the folder of the first
/// unless the current folder lies in there, its interpreter's libraries, and those of the option `reads`.
std::vector<std::filesystem::path> ReadableBy(const SuiteIdentifier& identifier);

/// Says on stderr, where there are commands among the identifiers, what they can reach, and warns of each of `secrets`
/// that one of them can read.
void ReportConfinement(const std::vector<SuiteIdentifier>& identifiers,
                       const std::vector<std::filesystem::path>& secrets, Confinement confinement);

/// A function of the caller's in place of a command: the same judging of the same answer.
PreparedIdentifier PrepareFunction(const std::string& label, const AnswerFunction& function);

/// Runs the command for each log in a fresh directory that holds the measurements alone, in a sandbox, under limits
/// (run_command.h): {recording} stands for recording.csv, {recording.h5} for HDF5, {estimate} for the estimate.json to
/// write. Its options: command, time_limit (s), memory (MiB of each process), reads (files and folders), beside
/// (whether it reads the folder of the first file that it names). A command that fails, takes too long or writes
/// something else throws NoAnswer: crashed, timeout, bad_answer. The answer is judged like those of our own identifiers
/// (check_estimate.h). Throws BadInput from `place` for wrong options, and where the kernel has no sandbox.
PreparedIdentifier PrepareExternal(const SuiteIdentifier& identifier, const Place& place,
                                   const LackOfFitSettings& judging, Confinement confinement);

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
