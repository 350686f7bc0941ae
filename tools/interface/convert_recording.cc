#include "tools/interface/convert_recording.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "models/foundation/serialize.h"
#include "models/recording/assemble.h"
#include "tools/interface/convert_numbers.h"

namespace warmjoint::api {
namespace {

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
  models::ReadSettings settings;
  settings.gear = recording.gear;
  models::CheckReadSettings(settings);
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

tools::RecordingSource ToSource(const Origin& origin) {
  tools::RecordingSource source;
  // which files, and which of their columns
  const ReadSettings& read = origin.read;
  source.files = origin.files;
  source.read.map = models::ColumnTexts(read.map.begin(), read.map.end());
  source.read.unit = models::ColumnTexts(read.unit.begin(), read.unit.end());
  source.read.scale = models::ColumnNumbers(read.scale.begin(), read.scale.end());

  // the joint, its sensors, and what is asked of constant speeds
  source.read.joint = ToKind(read.joint);
  source.read.gear = read.gear;
  source.read.wrap = read.wrap;
  source.read.torque_constant = read.torque_constant;
  source.prepare = {origin.prepare.trim, origin.prepare.shortest_hold};

  // what a project file has set of these
  if (!origin.project_file.empty()) {
    const models::Node values = models::ParseJsonNode(origin.project, "Origin::project");
    source.project =
        tools::TakenProject{origin.project_file, models::ReadAs<tools::Project>(values)};
  }
  return source;
}

Origin FromSource(const tools::RecordingSource& source) {
  Origin origin;
  // which files, and which of their columns
  const models::ReadSettings& read = source.read;
  origin.files = source.files;
  origin.read.map = read.map;
  origin.read.unit = read.unit;
  origin.read.scale = read.scale;

  // the joint, its sensors, and what is asked of constant speeds
  origin.read.joint = FromKind(read.joint);
  origin.read.gear = read.gear;
  origin.read.wrap = read.wrap;
  origin.read.torque_constant = read.torque_constant;
  origin.prepare = {source.prepare.trim, source.prepare.shortest_hold};
  if (source.project) {
    origin.project_file = source.project->file;
    origin.project = models::WriteFields(source.project->values).dump();
  }
  return origin;
}

}  // namespace warmjoint::api
