// Where a recording comes from and how it is read, as commands and the public interface are told.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "identification/preparation/prepared_log.h"
#include "identification/preparation/select.h"
#include "models/foundation/bad_input.h"
#include "models/recording/csv.h"
#include "tools/actions/project_file.h"

namespace warmjoint::inline tools {

/// What was taken of a project file.
struct TakenProject {
  std::filesystem::path file;
  Project values;
};

/// The files of a recording, and what the command line says of them.
struct RecordingArguments {
  std::vector<std::string> recordings;
  std::vector<std::string> map;   // "torque=force_N"
  std::vector<std::string> unit;  // "position=deg"
  std::string joint = "rotary";
  double gear = 1;
  std::vector<std::string> scale;  // "torque=-1"
  double wrap = 0;                 // in the unit of the position; 0: a turn
  HoldOptions holds;
  double torque_constant = 0;             // N.m/A or N/A at the joint; 0: not given
  std::optional<TakenProject> project{};  // whose values stand above
};

/// Rotary or linear, as the command line says.
JointKind JointOf(const RecordingArguments& arguments);

/// Files and options as they are typed on a command line, what is at its default left out.
std::vector<std::string> WordsOf(const RecordingArguments& arguments);

/// How the files are to be read. Throws BadInput for a gear or a range that is no such number.
CsvLayout LayoutOf(const RecordingArguments& arguments);

/// {files[], map[], unit[], joint, gear}, the pairs sorted, and {scale[], wrap, trim, shortest_hold} where one of them
/// is given: the `recording` member of an estimate file, by which its pictures find the data again.
/// estimate: that file; the recordings are named as seen from its folder, so that both can be found from
/// anywhere and moved together. Empty: they are named as they are.
nlohmann::json RecordingToJson(const RecordingArguments& arguments,
                               const std::filesystem::path& estimate = {});

/// {file, values{}}: the `project` member of that file, what a project file set.
nlohmann::json TakenProjectToJson(const TakenProject& project,
                                  const std::filesystem::path& estimate = {});

/// The inverse. place: of that file. Throws BadInput from it.
TakenProject TakenProjectFromJson(const nlohmann::json& json, const Place& place);

/// The inverse of RecordingToJson. place: of the estimate file; a recording that is not where it was is
/// looked for beside that file. Throws BadInput from `place`.
RecordingArguments RecordingFromJson(const nlohmann::json& json, const Place& place);

/// Reads the recordings, several joined (join_recordings.h). Throws BadInput.
Measurements ReadRecording(const RecordingArguments& arguments);

/// Reads the recordings, joined, and prepares them with --trim and --shortest-hold.
PreparedLog ReadAndPrepare(const RecordingArguments& arguments);

/// Reads each by itself.
std::vector<Measurements> ReadRecordings(const RecordingArguments& arguments);

/// "key=value" pairs as a map. option: their name on the command line. Throws BadInput for a pair
/// without '=', or a key that stands there twice.
std::map<std::string, std::string> ReadPairs(const std::vector<std::string>& pairs,
                                             const std::string& option);

}  // namespace warmjoint::inline tools
