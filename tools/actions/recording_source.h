// Where a recording comes from and how it is read, as commands and the public interface are told.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/prepared_log.h>

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

}  // namespace warmjoint
