#include "tools/actions/recording_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "identification/preparation/prepare.h"
#include "models/foundation/atomic_file.h"
#include "models/foundation/excerpt.h"
#include "models/recording/join_recordings.h"
#include "models/recording/read_recording.h"
#include "tools/actions/read_member.h"

namespace warmjoint::inline tools {
namespace fs = std::filesystem;
namespace {

/// The same for pairs in any order.
std::vector<std::string> Sorted(std::vector<std::string> pairs) {
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

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

JointKind JointOf(const RecordingArguments& arguments) {
  return arguments.joint == "linear" ? JointKind::linear : JointKind::rotary;
}

std::vector<std::string> WordsOf(const RecordingArguments& arguments) {
  std::vector<std::string> words = arguments.recordings;
  const auto add = [&](const char* option, const std::string& value) {
    words.insert(words.end(), {option, value});
  };
  for (const std::string& pair : arguments.map) add("--map", pair);
  for (const std::string& pair : arguments.unit) add("--unit", pair);
  for (const std::string& pair : arguments.scale) add("--scale", pair);
  // what is as usual needs no words
  const RecordingArguments usual;
  if (arguments.wrap != usual.wrap) add("--wrap", fmt::format("{}", arguments.wrap));
  if (arguments.joint != usual.joint) add("--joint", arguments.joint);
  if (arguments.gear != usual.gear) add("--gear", fmt::format("{}", arguments.gear));
  const auto& [trim, shortest] = arguments.holds;
  if (trim != usual.holds.trim) add("--trim", fmt::format("{}", trim));
  if (shortest != usual.holds.shortest) add("--shortest-hold", fmt::format("{}", shortest));
  return words;
}

nlohmann::json RecordingToJson(const RecordingArguments& arguments, const fs::path& estimate) {
  std::vector<std::string> files;
  for (const std::string& file : arguments.recordings) files.push_back(SeenFrom(file, estimate));
  nlohmann::json json{{"files", files},
                      {"map", Sorted(arguments.map)},
                      {"unit", Sorted(arguments.unit)},
                      {"joint", arguments.joint},
                      {"gear", arguments.gear}};

  // what is rarely asked for stands there only where it is
  if (!arguments.scale.empty()) json["scale"] = Sorted(arguments.scale);
  if (arguments.wrap != 0) json["wrap"] = arguments.wrap;
  if (arguments.torque_constant != 0) json["torque_constant"] = arguments.torque_constant;
  if (arguments.holds.trim != 0) json["trim"] = arguments.holds.trim;
  if (arguments.holds.shortest != 0) json["shortest_hold"] = arguments.holds.shortest;
  return json;
}

nlohmann::json TakenProjectToJson(const TakenProject& project, const fs::path& estimate) {
  return {{"file", SeenFrom(project.file, estimate)}, {"values", ProjectToJson(project.values)}};
}

TakenProject TakenProjectFromJson(const nlohmann::json& json, const Place& place) {
  return ReadMember("project", place, "", [&] {
    return TakenProject{Found(json.at("file").get<std::string>(), place.file),
                        ProjectFromJson(json.at("values"))};
  });
}

RecordingArguments RecordingFromJson(const nlohmann::json& json, const Place& place) {
  RecordingArguments arguments = ReadMember("recording", place, ": give --recording", [&] {
    RecordingArguments read;
    json.at("files").get_to(read.recordings);
    json.at("map").get_to(read.map);
    json.at("unit").get_to(read.unit);
    json.at("joint").get_to(read.joint);
    json.at("gear").get_to(read.gear);
    // what is rarely asked for may be absent
    read.scale = json.value("scale", read.scale);
    read.wrap = json.value("wrap", 0.0);
    read.torque_constant = json.value("torque_constant", 0.0);
    read.holds = {json.value("trim", 0.0), json.value("shortest_hold", 0.0)};
    return read;
  });
  // files are named as they are seen from the estimate
  for (std::string& file : arguments.recordings) {
    if (IsStandardInput(file)) {
      Refuse(place, "its recording was read from standard input; give it with --recording");
    }
    file = Found(file, place.file);
  }
  return arguments;
}

Measurements ReadRecording(const RecordingArguments& arguments) {
  return JoinRecordings(ReadRecordings(arguments));
}

PreparedLog ReadAndPrepare(const RecordingArguments& arguments) {
  return Prepare(ReadRecording(arguments), arguments.holds);
}

CsvLayout LayoutOf(const RecordingArguments& arguments) {
  // numbers that cannot be meant are refused before anything is read
  if (!std::isfinite(arguments.gear) || arguments.gear == 0) {
    Refuse({"--gear"}, "is {}; it must be a finite number other than 0", arguments.gear);
  }
  if (!std::isfinite(arguments.wrap) || arguments.wrap < 0) {
    Refuse({"--wrap"}, "is {}; it must be a finite number above 0", arguments.wrap);
  }
  if (!std::isfinite(arguments.torque_constant)) {
    Refuse({"--torque-constant"}, "is {}; it must be a finite number, N.m/A or N/A at the joint",
           arguments.torque_constant);
  }
  // columns, units and factors, and what joint they are of
  CsvLayout layout;
  layout.scale = ReadPairs(arguments.scale, "--scale");
  layout.wrap = arguments.wrap;
  layout.column = ReadPairs(arguments.map, "--map");
  layout.unit = ReadPairs(arguments.unit, "--unit");
  layout.joint = JointOf(arguments);
  layout.gear = arguments.gear;
  return layout;
}

std::vector<Measurements> ReadRecordings(const RecordingArguments& arguments) {
  const CsvLayout layout = LayoutOf(arguments);
  std::vector<Measurements> recordings;
  for (const std::string& path : arguments.recordings) {
    recordings.push_back(ReadRecordingFile(path, layout));
    if (arguments.torque_constant != 0) {
      TakeTorqueConstant(arguments.torque_constant, recordings.back());
    }
  }
  return recordings;
}

}  // namespace warmjoint::inline tools
