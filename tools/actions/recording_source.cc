#include "tools/actions/recording_source.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "models/foundation/excerpt.h"
#include "models/recording/join_recordings.h"
#include "models/recording/read_recording.h"

namespace warmjoint::inline tools {
namespace {

/// The same for pairs in any order.
std::vector<std::string> Sorted(std::vector<std::string> pairs) {
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace

std::map<std::string, std::string> ReadPairs(const std::vector<std::string>& pairs,
                                             const std::string& option) {
  std::map<std::string, std::string> map;
  for (const std::string& pair : pairs) {
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

nlohmann::json RecordingToJson(const RecordingArguments& arguments) {
  nlohmann::json json{{"files", arguments.recordings},
                      {"map", Sorted(arguments.map)},
                      {"unit", Sorted(arguments.unit)},
                      {"joint", arguments.joint},
                      {"gear", arguments.gear}};

  // what is rarely asked for stands there only where it is
  if (!arguments.scale.empty()) json["scale"] = Sorted(arguments.scale);
  if (arguments.wrap != 0) json["wrap"] = arguments.wrap;
  if (arguments.holds.trim != 0) json["trim"] = arguments.holds.trim;
  if (arguments.holds.shortest != 0) json["shortest_hold"] = arguments.holds.shortest;
  return json;
}

RecordingArguments RecordingFromJson(const nlohmann::json& json, const Place& place) {
  RecordingArguments arguments;
  try {
    json.at("files").get_to(arguments.recordings);
    json.at("map").get_to(arguments.map);
    json.at("unit").get_to(arguments.unit);
    json.at("joint").get_to(arguments.joint);
    json.at("gear").get_to(arguments.gear);
    arguments.scale = json.value("scale", arguments.scale);
    arguments.wrap = json.value("wrap", 0.0);
    arguments.holds = {json.value("trim", 0.0), json.value("shortest_hold", 0.0)};
  } catch (const nlohmann::json::exception& error) {
    Refuse(place, "its member `recording` cannot be read ({}): give --recording", error.what());
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
  if (!std::isfinite(arguments.gear) || arguments.gear == 0) {
    Refuse({"--gear"}, "is {}; it must be a finite number other than 0", arguments.gear);
  }
  if (!std::isfinite(arguments.wrap) || arguments.wrap < 0) {
    Refuse({"--wrap"}, "is {}; it must be a finite number above 0", arguments.wrap);
  }
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
    recordings.push_back(ReadForeignRecording(path, layout));
  }
  return recordings;
}

}  // namespace warmjoint::inline tools
