// Where a recording comes from and how it is read, as commands are told.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/prepared_log.h>
#include <warmjoint/recording.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace warmjoint {

/// Files and options as they are typed on a command line, what is at its default left out.
std::vector<std::string> WordsOf(const RecordingSource& source);

/// Reads the recordings, joined, and prepares them with --trim and --shortest-hold.
PreparedLog ReadAndPrepare(const RecordingSource& source);

/// The recording that an estimate tells of; nothing where it tells of none. file: of the estimate. Throws BadInput for one that
/// was read from standard input.
std::optional<RecordingSource> RecordingOf(const Estimate& estimate, const std::string& file);

/// "key=value" pairs as a map. option: their name on the command line. Throws BadInput for a pair
/// without '=', or a key that stands there twice.
std::map<std::string, std::string> ReadPairs(const std::vector<std::string>& pairs,
                                             const std::string& option);

/// The file beside a recording that describes it (Project).
inline constexpr const char* kProjectFile = "warmjoint.yaml";

/// Reads the text of a project file. Throws BadInput with `file` and line for what is no YAML, a key or
/// column that there is not (with the nearest), a value out of its bounds, and for a command or an
/// identifier: a file that lies beside a log from elsewhere must not choose what runs.
Project ParseProject(const std::string& text, const std::string& file);

}  // namespace warmjoint
