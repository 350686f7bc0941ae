#include "tools/interface/convert_recording.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "models/foundation/parse_number.h"
#include "models/foundation/read_json.h"
#include "models/recording/assemble.h"
#include "tools/interface/convert_numbers.h"

namespace warmjoint::api {
namespace {

std::vector<std::string> Pairs(const std::map<std::string, std::string>& map) {
  std::vector<std::string> pairs;
  for (const auto& [key, value] : map) pairs.push_back(key + "=" + value);
  return pairs;
}

/// A column of N samples.
Eigen::VectorXd Column(const std::vector<double>& values, const char* name,
                       const Recording& recording) {
  if (values.size() != recording.time.size()) {
    models::Refuse({recording.source}, "{} has {} values and time has {}; give one for each sample",
                   name, values.size(), recording.time.size());
  }
  return ToEigen(values);
}

std::optional<Eigen::VectorXd> Column(const std::optional<std::vector<double>>& values,
                                      const char* name, const Recording& recording) {
  if (!values) return std::nullopt;
  return Column(*values, name, recording);
}

std::optional<std::vector<double>> FromColumn(const std::optional<Eigen::VectorXd>& values) {
  if (!values) return std::nullopt;
  return FromEigen(*values);
}

/// The samples at which recordings that were joined begin.
std::vector<Eigen::Index> Starts(const Recording& recording) {
  // they ascend, and the first recording begins at sample 0, which is not listed
  std::vector<Eigen::Index> starts;
  std::size_t last = 0;
  for (const std::size_t start : recording.starts) {
    if (start <= last || start >= recording.time.size()) {
      models::Refuse({recording.source},
                     "starts has {} after {}; they must ascend between 0 and the {} samples", start,
                     last, recording.time.size());
    }
    last = start;
    starts.push_back(static_cast<Eigen::Index>(start));
  }
  return starts;
}

}  // namespace

models::JointKind ToKind(JointKind joint) {
  return joint == JointKind::linear ? models::JointKind::linear : models::JointKind::rotary;
}

JointKind FromKind(models::JointKind joint) {
  return joint == models::JointKind::linear ? JointKind::linear : JointKind::rotary;
}

models::Measurements ToMeasurements(const Recording& recording) {
  models::Measurements log;
  // what is known of the joint and of the recording
  log.joint = ToKind(recording.joint);
  log.torque_unit = recording.torque_unit;
  log.gear = recording.gear;
  log.source = recording.source;
  log.notes = recording.notes;

  // columns, of which only some must be there
  log.time = ToEigen(recording.time);
  log.position = Column(recording.position, "position", recording);
  if (!recording.velocity.empty()) log.velocity = Column(recording.velocity, "velocity", recording);
  log.torque = Column(recording.torque, "torque", recording);
  log.motor_position = Column(recording.motor_position, "motor_position", recording);
  log.load = Column(recording.load, "load", recording);
  log.temperature = Column(recording.temperature, "temperature", recording);
  log.starts = Starts(recording);

  // samples and gear are checked as those of a file are
  models::CheckSamples(log);
  tools::RecordingArguments arguments;
  arguments.gear = recording.gear;
  tools::LayoutOf(arguments);
  return log;
}

Recording FromMeasurements(const models::Measurements& log) {
  Recording recording;
  // what is known of the joint and of the recording
  recording.joint = FromKind(log.joint);
  recording.torque_unit = log.torque_unit;
  recording.gear = log.gear;
  recording.source = log.source;
  recording.notes = log.notes;

  // columns, of which only some must be there
  recording.time = FromEigen(log.time);
  recording.position = FromEigen(log.position);
  recording.velocity = FromEigen(log.velocity);
  recording.torque = FromEigen(log.torque);
  recording.motor_position = FromColumn(log.motor_position);
  recording.load = FromColumn(log.load);
  recording.temperature = FromColumn(log.temperature);
  recording.starts.assign(log.starts.begin(), log.starts.end());
  return recording;
}

tools::RecordingArguments ToArguments(const Origin& origin) {
  tools::RecordingArguments arguments;
  // pairs as the command line takes them
  arguments.recordings = origin.files;
  arguments.map = Pairs(origin.read.map);
  arguments.unit = Pairs(origin.read.unit);
  for (const auto& [column, factor] : origin.read.scale) {
    arguments.scale.push_back(fmt::format("{}={}", column, factor));
  }

  // the joint, its sensors, and what is asked of constant speeds
  arguments.joint = origin.read.joint == JointKind::linear ? "linear" : "rotary";
  arguments.gear = origin.read.gear;
  arguments.wrap = origin.read.wrap;
  arguments.torque_constant = origin.read.torque_constant;
  arguments.holds = {origin.prepare.trim, origin.prepare.shortest_hold};

  // what a project file has set of these
  if (!origin.project_file.empty()) {
    const auto values = models::ParseJson(origin.project, "Origin::project");
    arguments.project = tools::TakenProjectFromJson(
        {{"file", origin.project_file}, {"values", values}}, {"Origin::project"});
  }
  return arguments;
}

Origin FromArguments(const tools::RecordingArguments& arguments, const models::Place& place) {
  Origin origin;
  // which files, and which of their columns
  origin.files = arguments.recordings;
  origin.read.map = tools::ReadPairs(arguments.map, "--map");
  origin.read.unit = tools::ReadPairs(arguments.unit, "--unit");
  // factors stand there as texts
  for (const auto& [column, text] : tools::ReadPairs(arguments.scale, "--scale")) {
    const std::optional<double> factor = models::ParseNumber(text);
    if (!factor) models::Refuse(place, "recording.scale of {} is not a number", column);
    origin.read.scale[column] = *factor;
  }

  // the joint, its sensors, and what is asked of constant speeds
  origin.read.joint = FromKind(tools::JointOf(arguments));
  origin.read.gear = arguments.gear;
  origin.read.wrap = arguments.wrap;
  origin.read.torque_constant = arguments.torque_constant;
  origin.prepare = {arguments.holds.trim, arguments.holds.shortest};
  if (arguments.project) {
    origin.project_file = arguments.project->file.string();
    origin.project = tools::ProjectToJson(arguments.project->values).dump();
  }
  return origin;
}

}  // namespace warmjoint::api
