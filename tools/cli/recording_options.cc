#include "tools/cli/recording_options.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/recording/join_recordings.h"
#include "models/recording/read_recording.h"

namespace warmjoint::inline tools {

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

void AddRecordingOptions(CLI::App& parser, RecordingArguments& arguments) {
  parser
      .add_option("RECORDING", arguments.recordings,
                  "CSV or HDF5 file; several of one joint, each from a cold start")
      ->required();
  AddLayoutOptions(parser, arguments);
}

void AddLayoutOptions(CLI::App& parser, RecordingArguments& arguments) {
  parser.add_option("--map", arguments.map, "columns of the file, as torque=force_N,time=t_s")
      ->delimiter(',')
      ->take_all();
  parser.add_option("--unit", arguments.unit, "units of the file, as position=deg,time=ms")
      ->delimiter(',')
      ->take_all();
  parser.add_option("--joint", arguments.joint, "rotary or linear")
      ->check(CLI::IsMember({"rotary", "linear"}))
      ->capture_default_str();
  parser.add_option("--gear", arguments.gear, "motor turns for each joint turn")
      ->capture_default_str();
}

nlohmann::json RecordingToJson(const RecordingArguments& arguments) {
  return {{"files", arguments.recordings},
          {"map", arguments.map},
          {"unit", arguments.unit},
          {"joint", arguments.joint},
          {"gear", arguments.gear}};
}

RecordingArguments RecordingFromJson(const nlohmann::json& json, const Place& place) {
  RecordingArguments arguments;
  try {
    json.at("files").get_to(arguments.recordings);
    json.at("map").get_to(arguments.map);
    json.at("unit").get_to(arguments.unit);
    json.at("joint").get_to(arguments.joint);
    json.at("gear").get_to(arguments.gear);
  } catch (const nlohmann::json::exception& error) {
    Refuse(place, "its member `recording` cannot be read ({}): give --recording", error.what());
  }
  return arguments;
}

Measurements ReadRecording(const RecordingArguments& arguments) {
  return JoinRecordings(ReadRecordings(arguments));
}

std::vector<Measurements> ReadRecordings(const RecordingArguments& arguments) {
  if (!std::isfinite(arguments.gear) || arguments.gear == 0) {
    Refuse({"--gear"}, "is {}; it must be a finite number other than 0", arguments.gear);
  }
  CsvLayout layout;
  layout.column = ReadPairs(arguments.map, "--map");
  layout.unit = ReadPairs(arguments.unit, "--unit");
  layout.joint = arguments.joint == "linear" ? JointKind::linear : JointKind::rotary;
  layout.gear = arguments.gear;
  std::vector<Measurements> recordings;
  for (const std::string& path : arguments.recordings) {
    recordings.push_back(ReadForeignRecording(path, layout));
  }
  return recordings;
}

}  // namespace warmjoint::inline tools
