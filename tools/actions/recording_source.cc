#include "tools/actions/recording_source.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "identification/preparation/prepare.h"
#include "models/foundation/atomic_file.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/serialize.h"
#include "models/recording/join_recordings.h"
#include "models/recording/read_recording.h"

namespace warmjoint::inline tools {
namespace fs = std::filesystem;
namespace {

/// A file as it is called from the folder of another one; as it is where it is no file of a folder.
std::string SeenFrom(const fs::path& file, const fs::path& other) {
  std::error_code ignored;
  if (other.empty() || IsStandardOutput(other) || !fs::is_regular_file(file, ignored)) return file;
  const fs::path relative = fs::relative(file, fs::absolute(other).parent_path(), ignored);
  return relative.empty() ? file : relative;
}

/// Where a file lies that another one names: seen from its folder, or as it is, or beside it; its name where
/// it is nowhere.
std::string Found(const fs::path& name, const fs::path& other) {
  const fs::path folder = other.parent_path();
  for (const fs::path& path : {folder / name, name, folder / name.filename()}) {
    std::error_code ignored;
    if (fs::exists(path, ignored)) return path;
  }
  return name;
}

/// Makes torque of a current, by the motor's constant seen at the joint.
void TakeTorqueConstant(double constant, Measurements& log) {
  const std::string_view unit = kTorqueUnit.For(log.joint);
  // what is a torque already needs no constant
  if (log.torque_unit != "A") {
    Refuse(
        {"--torque-constant"},
        "makes torque of a current, and the torque of {} is in {}; give --unit torque=A where it "
        "is in amperes",
        log.source, log.torque_unit);
  }
  // the motor's current becomes torque at the joint
  log.torque *= constant;
  log.torque_unit = unit;
  log.notes.push_back(fmt::format("torque: current times {:.6g} {}/A", constant, unit));
}

}  // namespace

std::map<std::string, std::string> ReadPairs(const std::vector<std::string>& pairs,
                                             const std::string& option) {
  std::map<std::string, std::string> map;
  for (const std::string& pair : pairs) {
    // a key before the sign, whatever follows is the value
    const size_t equals = pair.find('=');
    if (equals == std::string::npos || equals == 0) {
      Refuse({option}, "'{}' is not of the form key=value", Excerpt(pair));
    }
    const std::string key = pair.substr(0, equals);
    if (!map.emplace(key, pair.substr(equals + 1)).second) {
      Refuse({option}, "'{}' is given twice; leave one", Excerpt(key));
    }
  }
  return map;
}

std::vector<std::string> WordsOf(const RecordingSource& source) {
  std::vector<std::string> words = source.files;
  const auto add = [&](const char* option, const auto& value) {
    words.insert(words.end(), {option, fmt::format("{}", value)});
  };
  const auto& [map, unit, scale, wrap, joint, gear, constant] = source.read;
  for (const auto& [column, text] : map) add("--map", column + "=" + text);
  for (const auto& [column, text] : unit) add("--unit", column + "=" + text);
  for (const auto& [column, factor] : scale) add("--scale", fmt::format("{}={}", column, factor));
  // what is as usual needs no words
  const ReadSettings usual;
  if (wrap != usual.wrap) add("--wrap", wrap);
  if (joint != usual.joint) add("--joint", NameOf(joint));
  if (gear != usual.gear) add("--gear", gear);
  if (constant != usual.torque_constant) add("--torque-constant", constant);
  if (source.prepare.trim != 0) add("--trim", source.prepare.trim);
  if (source.prepare.shortest_hold != 0) add("--shortest-hold", source.prepare.shortest_hold);
  return words;
}

void AddRecording(const RecordingSource& source, const fs::path& target, Tree& estimate) {
  RecordingSource seen = source;
  for (std::string& file : seen.files) file = SeenFrom(file, target);
  estimate["recording"] = WriteFields(seen);
  if (!seen.project) return;
  seen.project->file = SeenFrom(seen.project->file, target);
  estimate["project"] = WriteFields(*seen.project);
}

std::optional<RecordingSource> RecordingIn(const Node& estimate) {
  const auto recording = estimate.Find("recording");
  if (!recording) return std::nullopt;
  RecordingSource source = ReadAs<RecordingSource>(recording->With(UnknownKeys::ignored));
  // files are named as they are seen from the estimate
  for (std::string& file : source.files) {
    if (IsStandardInput(file)) {
      Refuse(recording->place(),
             "its recording was read from standard input; give it with --recording");
    }
    file = Found(file, estimate.file());
  }
  if (const auto project = estimate.Find("project")) {
    source.project = ReadAs<TakenProject>(project->With(UnknownKeys::ignored));
    source.project->file = Found(source.project->file, estimate.file());
  }
  return source;
}

Measurements ReadRecording(const RecordingSource& source) {
  return JoinRecordings(ReadRecordings(source));
}

PreparedLog ReadAndPrepare(const RecordingSource& source) {
  return Prepare(ReadRecording(source), source.prepare);
}

std::vector<Measurements> ReadRecordings(const RecordingSource& source) {
  // numbers that cannot be meant are refused before anything is read
  CheckReadSettings(source.read);
  std::vector<Measurements> recordings;
  for (const std::string& path : source.files) {
    recordings.push_back(ReadRecordingFile(path, source.read));
    if (source.read.torque_constant != 0) {
      TakeTorqueConstant(source.read.torque_constant, recordings.back());
    }
  }
  return recordings;
}

}  // namespace warmjoint::inline tools
