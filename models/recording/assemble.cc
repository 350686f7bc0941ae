#include "models/recording/assemble.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "models/foundation/excerpt.h"
#include "models/foundation/parse_number.h"
#include "models/recording/measurements.h"
#include "models/recording/unwrap.h"

namespace warmjoint {
namespace {

constexpr double kLargest = 1e30;       // of any value; beyond it squares and products overflow
constexpr double kShortestStep = 1e-9;  // s, on average

void CheckValues(const RawColumns& raw, const std::string& column, const Eigen::VectorXd& values) {
  // NaN fails the comparison too
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (std::abs(values[i]) <= kLargest) continue;
    Refuse(
        raw.At(i),
        "{} of sample {} is {}; it must be a finite number of size {} at most. Cut the log there "
        "or repair it",
        column, i + 1, values[i], kLargest);
  }
}

void CheckTime(const RawColumns& raw, const Eigen::VectorXd& time) {
  // stamps increase from sample to sample
  for (Eigen::Index i = 1; i < time.size(); ++i) {
    if (time[i] > time[i - 1]) continue;
    if (time[i] == time[i - 1]) {
      Refuse(raw.At(i), "time {} s of sample {} is that of the sample before; drop one of them",
             time[i], i + 1);
    }
    Refuse(raw.At(i),
           "time of sample {} is {} s, after {} s: it runs backwards. Split the file there or sort "
           "it by time",
           i + 1, time[i], time[i - 1]);
  }
  // steps that are far too short tell of another unit
  const Eigen::Index n = time.size();
  const double step = (time[n - 1] - time[0]) / static_cast<double>(n - 1);
  if (step < kShortestStep) {
    Refuse({raw.file},
           "samples are {} s apart, less than {} s, the least that is read; give the unit of time, "
           "for example --unit time=ms",
           step, kShortestStep);
  }
}

void CheckTorque(const RawColumns& raw, const Measurements& measurements) {
  const Eigen::VectorXd& torque = measurements.torque;
  if (torque.maxCoeff() > torque.minCoeff()) return;
  Refuse({raw.file},
         "torque is {} {} in all {} samples; is it the right column (--map torque=NAME)?",
         torque[0], measurements.torque_unit, torque.size());
}

/// Number of samples, time and torque.
void CheckCourse(const RawColumns& raw, const Measurements& measurements) {
  const Eigen::Index n = measurements.size();
  if (n < 3) Refuse({raw.file}, "has {} samples; at least 3 are needed", n);
  if (n > kMostSamples) {
    Refuse({raw.file}, "has {} samples; {} at most are read: cut it, or lower its rate", n,
           kMostSamples);
  }
  CheckTime(raw, measurements.time);
  CheckTorque(raw, measurements);
}

/// The integral of the velocity from 0, straight between samples.
void IntegrateVelocity(Measurements& measurements) {
  const Eigen::VectorXd &time = measurements.time, &velocity = measurements.velocity;
  Eigen::VectorXd& position = measurements.position;
  position.setZero(measurements.size());
  for (Eigen::Index i = 1; i < position.size(); ++i) {
    position[i] = position[i - 1] + (time[i] - time[i - 1]) * (velocity[i] + velocity[i - 1]) / 2;
  }
  measurements.position_integrated = true;
  measurements.notes.emplace_back(kNoPositions);
}

/// The factor on a column, 1 where none is given.
double ScaleOf(const std::string& column, const ReadSettings& layout) {
  const auto given = layout.scale.find(column);
  return given == layout.scale.end() ? 1 : given->second;
}

/// Position without the jumps of a sensor that starts its turn, or its range, again. range: rad or
/// m; 0: a turn, of a rotary joint.
void Unwrap(double range, Measurements& measurements) {
  // a linear sensor has no turn
  if (range == 0 && measurements.joint != JointKind::rotary) return;
  const Eigen::VectorXd &time = measurements.time, &velocity = measurements.velocity;
  Eigen::VectorXd& position = measurements.position;

  // by the range that is given, else by turns, with the speed to tell jumps from motion
  const int jumps = range > 0 ? UnwrapRange(time, velocity, range, position)
                              : UnwrapTurns(time, velocity, position);
  if (jumps == 0) return;
  measurements.notes.push_back(
      range > 0 ? fmt::format("position jumps by its range {} times; unwrapped", jumps)
                : fmt::format("position jumps by a turn {} times; unwrapped", jumps));
}

}  // namespace

Measurements AssembleMeasurements(RawColumns raw, const std::vector<ColumnSource>& sources,
                                  const ReadSettings& layout) {
  // what is known beside the columns
  CheckReadSettings(layout);
  Measurements measurements;
  measurements.joint = layout.joint;
  measurements.gear = layout.gear;
  measurements.source = raw.file;

  // to SI, each value checked
  double range = 0;  // after which the position sensor starts again, rad or m
  for (std::size_t k = 0; k < sources.size(); ++k) {
    const auto& [column, index, unit, found_as] = sources[k];
    CheckValues(raw, column->name, raw.values[k]);
    Eigen::VectorXd values = std::move(raw.values[k]);
    const double scale = ScaleOf(column->name, layout);
    if (unit.factor != 1 || unit.offset != 0 || scale != 1) {
      values = unit.factor * scale * values.array() + unit.offset;
    }
    // the range of the sensor, in the unit of the position
    if (column->name == "position") range = std::abs(unit.factor * scale) * layout.wrap;
    if (column->name == "torque") measurements.torque_unit = unit.base;
    column->set(measurements, std::move(values));
    if (!found_as.empty()) {
      measurements.notes.push_back(
          fmt::format("{} from the column '{}'", column->name, Excerpt(found_as)));
    }
  }

  // all of it at once: at least three samples, in order, with a torque that changes
  CheckCourse(raw, measurements);
  if (measurements.position.size() == 0) {
    IntegrateVelocity(measurements);
  } else {
    Unwrap(range, measurements);
  }
  return measurements;
}

std::vector<std::string> NamesOf(const FileContent& content) {
  std::vector<std::string> names;
  for (const FileColumn& column : content.columns) names.push_back(column.name);
  return names;
}

ReadSettings WithAttributes(ReadSettings layout, const FileContent& content) {
  // what the file says of itself, where nobody says otherwise
  if (content.joint == "linear") layout.joint = JointKind::linear;
  if (layout.gear == 1 && content.gear) layout.gear = *content.gear;
  for (const RecordingColumn& column : RecordingColumns()) {
    const auto mapped = layout.map.find(column.name);
    const std::string theirs = mapped == layout.map.end() ? column.name : mapped->second;
    const auto found = std::find_if(content.columns.begin(), content.columns.end(),
                                    [&](const FileColumn& one) { return one.name == theirs; });
    if (found != content.columns.end() && !found->unit.empty()) {
      layout.unit.emplace(column.name, found->unit);
    }
  }
  return layout;
}

Measurements AssembleContent(const FileContent& content, const std::string& path,
                             const ReadSettings& given) {
  const ReadSettings layout = WithAttributes(given, content);
  const std::vector<ColumnSource> sources = FindColumns(NamesOf(content), layout, {path});
  // the columns that are asked for, all of one length
  RawColumns raw{path, {}, {}};
  for (const ColumnSource& source : sources) {
    raw.values.push_back(content.columns[source.index].values);
    if (raw.values.back().size() == raw.values.front().size()) continue;
    Refuse({path}, "{} has {} samples where {} has {}; all columns must be of one length",
           content.columns[source.index].name, raw.values.back().size(),
           content.columns[sources.front().index].name, raw.values.front().size());
  }
  return AssembleMeasurements(std::move(raw), sources, layout);
}

}  // namespace warmjoint
