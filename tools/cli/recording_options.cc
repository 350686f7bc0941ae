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
  parser
      .add_option("--scale", arguments.scale,
                  "factors on the columns of the file, as torque=-1,velocity=0.5")
      ->delimiter(',')
      ->take_all();
  parser.add_option(
      "--wrap", arguments.wrap,
      "range after which the position starts again, in its unit; a turn is undone anyway");
  parser.add_option("--joint", arguments.joint, "rotary or linear")
      ->check(CLI::IsMember({"rotary", "linear"}))
      ->capture_default_str();
  parser.add_option("--gear", arguments.gear, "motor turns for each joint turn")
      ->capture_default_str();
}

void AddHoldOptions(CLI::App& parser, HoldOptions& holds) {
  parser.add_option("--trim", holds.trim, "s to leave out at each end of a constant speed")
      ->check(CLI::NonNegativeNumber);
  parser
      .add_option("--shortest-hold", holds.shortest,
                  "s; a constant speed that lasts less is left out")
      ->check(CLI::NonNegativeNumber);
}

nlohmann::json RecordingToJson(const RecordingArguments& arguments) {
  nlohmann::json json{{"files", arguments.recordings},
                      {"map", arguments.map},
                      {"unit", arguments.unit},
                      {"joint", arguments.joint},
                      {"gear", arguments.gear}};

  // what is rarely asked for stands there only where it is
  if (!arguments.scale.empty()) json["scale"] = arguments.scale;
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

std::vector<Measurements> ReadRecordings(const RecordingArguments& arguments) {
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
  layout.joint = arguments.joint == "linear" ? JointKind::linear : JointKind::rotary;
  layout.gear = arguments.gear;
  std::vector<Measurements> recordings;
  for (const std::string& path : arguments.recordings) {
    recordings.push_back(ReadForeignRecording(path, layout));
  }
  return recordings;
}

}  // namespace warmjoint::inline tools
