// Where a recording comes from and how it is read, as commands and the public interface are told.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "identification/preparation/prepared_log.h"
#include "identification/preparation/select.h"
#include "models/foundation/bad_input.h"
#include "models/recording/read_settings.h"
#include "tools/actions/project_file.h"

namespace warmjoint::inline tools {

/// What was taken of a project file.
struct TakenProject {
  std::string file;
  Project values;

  template <class A>
  void Serialize(A* a) {
    a->Field("file", &file, {.needed = "name it"});
    a->Field("values", &values, {.needed = "give what it set"});
  }
};

/// The files of a recording, and how they are read: the `recording` member of an estimate file, by which its pictures find
/// the data again.
struct RecordingSource {
  std::vector<std::string> files;
  ReadSettings read;
  PrepareSettings prepare;
  std::optional<TakenProject> project{};  // whose values stand above; a member `project` of its own

  template <class A>
  void Serialize(A* a) {
    a->Field("files", &files, {.needed = "give --recording"});
    read.Serialize(a);
    prepare.Serialize(a);
  }
};

/// Files and options as they are typed on a command line, what is at its default left out.
std::vector<std::string> WordsOf(const RecordingSource& source);

/// Adds the members `recording` and, where there is one, `project` to an estimate file. target: that file; the recordings are
/// named as seen from its folder, so that both can be found from anywhere and moved together. Empty: they are named as
/// they are.
void AddRecording(const RecordingSource& source, const std::filesystem::path& target,
                  Tree& estimate);

/// The inverse; nothing where the file has no `recording`. A recording that is not where it was is looked for beside
/// that file. Throws BadInput.
std::optional<RecordingSource> RecordingIn(const Node& estimate);

/// Reads the recordings, several joined (join_recordings.h). Throws BadInput.
Measurements ReadRecording(const RecordingSource& source);

/// Reads the recordings, joined, and prepares them with --trim and --shortest-hold.
PreparedLog ReadAndPrepare(const RecordingSource& source);

/// Reads each by itself.
std::vector<Measurements> ReadRecordings(const RecordingSource& source);

/// "key=value" pairs as a map. option: their name on the command line. Throws BadInput for a pair
/// without '=', or a key that stands there twice.
std::map<std::string, std::string> ReadPairs(const std::vector<std::string>& pairs,
                                             const std::string& option);

}  // namespace warmjoint::inline tools
