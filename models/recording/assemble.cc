#include "models/recording/assemble.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>

#include "models/foundation/excerpt.h"
#include "models/recording/clock.h"
#include "models/recording/measurements.h"
#include "models/recording/unwrap.h"

namespace warmjoint {
namespace {

constexpr double kLargest = 1e30;       // of any value; beyond it squares and products overflow
constexpr double kShortestStep = 1e-9;  // s, on average
// where nobody says the unit of time: no drive samples faster than every 10 us, and no friction shows at a sample in 100 s
constexpr double kFastest = 1e-5, kSlowest = 100;  // s
constexpr double kSlow = 2;                        // s, from which milliseconds are likelier
constexpr double kFast =
    30;  // rad/s on average: no joint of a robot turns so fast, in degrees many do

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

void CheckTime(const RawColumns& raw, bool is_assumed, Measurements& measurements) {
  const Eigen::VectorXd& time = measurements.time;
  // stamps increase from sample to sample
  for (Eigen::Index i = 1; i < time.size(); ++i) {
    if (time[i] > time[i - 1]) continue;
    if (time[i] == time[i - 1]) {
      Refuse(
          raw.At(i),
          "time {} s of sample {} is that of the sample before; drop one of them, or keep the rows "
          "of one joint",
          time[i], i + 1);
    }
    Refuse(raw.At(i),
           "time of sample {} is {} s, after {} s: it runs backwards. Split the file there or sort "
           "it by time",
           i + 1, time[i], time[i - 1]);
  }
  // steps that are far too short or too long tell of another unit
  const Eigen::Index n = time.size();
  const double step = (time[n - 1] - time[0]) / static_cast<double>(n - 1);
  if (step < (is_assumed ? kFastest : kShortestStep) || (is_assumed && step > kSlowest)) {
    Refuse({raw.file},
           "samples are {:.4g} s apart if time is in s; give its unit: --unit time=ns, us, ms, s, "
           "min, h "
           "or d",
           step);
  }
  if (is_assumed && step > kSlow) {
    measurements.notes.push_back(
        fmt::format("samples are {:.4g} s apart; if time is in ms give --unit time=ms", step));
  }
}

/// Says that a joint turns as one does whose degrees were taken for radians.
void NoteSpeed(const std::vector<ColumnSource>& sources, Measurements& measurements) {
  const auto is_assumed = [](const ColumnSource& one) {
    return one.column->name == "position" && one.unit_from == UnitFrom::usual;
  };
  if (measurements.joint != JointKind::rotary || std::ranges::none_of(sources, is_assumed)) return;
  const Eigen::VectorXd &time = measurements.time, &position = measurements.position;
  const Eigen::Index n = time.size();
  const double way = (position.tail(n - 1) - position.head(n - 1)).cwiseAbs().sum();
  const double speed = way / (time[n - 1] - time[0]);
  if (speed <= kFast) return;
  measurements.notes.push_back(fmt::format(
      "the joint turns at {:.4g} rev/min on average; if positions are in degrees give --unit "
      "position=deg,velocity=deg/s",
      speed * 30 / std::numbers::pi));
}

void CheckTorque(const RawColumns& raw, const Measurements& measurements) {
  const Eigen::VectorXd& torque = measurements.torque;
  if (torque.maxCoeff() > torque.minCoeff()) return;
  Refuse({raw.file},
         "torque is {} {} in all {} samples; is it the right column (--map torque=NAME)?",
         torque[0], measurements.torque_unit, torque.size());
}

/// Number of samples, time and torque. is_assumed: nobody says the unit of time.
void CheckCourse(const RawColumns& raw, bool is_assumed, Measurements& measurements) {
  const Eigen::Index n = measurements.size();
  if (n < 3) {
    const std::string left_out = fmt::format("{}", fmt::join(measurements.notes, "; "));
    Refuse({raw.file}, "has {} samples; at least 3 are needed{}{}", n, left_out.empty() ? "" : ": ",
           left_out);
  }
  if (n > kMostSamples) {
    Refuse({raw.file}, "has {} samples; {} at most are read: cut it, or lower its rate", n,
           kMostSamples);
  }
  CheckTime(raw, is_assumed, measurements);
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

/// Keeps the samples for which `keep` holds.
void Keep(const std::vector<bool>& keep, RawColumns& raw) {
  Eigen::Index kept = 0;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (!keep[i]) continue;
    for (Eigen::VectorXd& values : raw.values) values[kept] = values[static_cast<Eigen::Index>(i)];
    if (!raw.line.empty()) raw.line[static_cast<std::size_t>(kept)] = raw.line[i];
    ++kept;
  }
  for (Eigen::VectorXd& values : raw.values) values.conservativeResize(kept);
  if (!raw.line.empty()) raw.line.resize(static_cast<std::size_t>(kept));
}

/// Leaves out optional columns that lack more numbers than they have: that loses less than the samples would.
void LeaveOutColumns(RawColumns& raw, std::vector<ColumnSource>& sources) {
  for (std::size_t k = sources.size(); k-- > 0;) {
    const RecordingColumn& column = *sources[k].column;
    const Eigen::Index lacking = raw.values[k].array().isNaN().count();
    if (column.required || 2 * lacking <= raw.values[k].size() || lacking == 0) continue;
    raw.notes.push_back(fmt::format("{} is left out: it has no number in {} of {} rows",
                                    column.name, lacking, raw.values[k].size()));
    raw.values.erase(raw.values.begin() + static_cast<std::ptrdiff_t>(k));
    sources.erase(sources.begin() + static_cast<std::ptrdiff_t>(k));
  }
}

/// Leaves out the samples that lack a number.
void LeaveOutRows(RawColumns& raw, const std::vector<ColumnSource>& sources) {
  std::vector<bool> keep(static_cast<std::size_t>(raw.values.front().size()), true);
  std::vector<std::string> lacking;
  for (std::size_t k = 0; k < raw.values.size(); ++k) {
    const Eigen::VectorXd& values = raw.values[k];
    if (!values.array().isNaN().any()) continue;
    lacking.push_back(sources[k].column->name);
    for (Eigen::Index i = 0; i < values.size(); ++i) {
      if (std::isnan(values[i])) keep[static_cast<std::size_t>(i)] = false;
    }
  }
  if (lacking.empty()) return;
  const auto left_out = std::ranges::count(keep, false);
  if (left_out == static_cast<std::ptrdiff_t>(keep.size())) {
    Refuse(
        {raw.file},
        "has no row with a number for each of {}; where each column has a clock of its own, first: "
        "tools/convert {} -o log.h5",
        fmt::join(lacking, ", "), raw.file);
  }
  raw.notes.push_back(fmt::format("{} of {} rows lack a number ({}) and are left out", left_out,
                                  keep.size(), fmt::join(lacking, ", ")));
  Keep(keep, raw);
}

/// Makes the first source the time in s, of a rate or of one or two columns. Whether nobody says its unit.
bool TakeTime(RawColumns& raw, std::vector<ColumnSource>& sources, const ReadSettings& layout) {
  ColumnSource& source = sources.front();
  Eigen::VectorXd& time = raw.values.front();
  bool is_assumed =
      source.unit_from == UnitFrom::usual && !raw.stamps && !layout.scale.contains("time");
  const auto to_seconds = [&](const ColumnSource& one) { return raw.stamps ? 1 : one.unit.factor; };
  time *= to_seconds(source);
  if (sources[1].is_added) {
    if (sources[1].unit_from == UnitFrom::usual && !raw.stamps) {
      Refuse(
          {raw.file},
          "--map time=A+B: the name of the second column must tell its unit, as nsecs or stamp_ns");
    }
    time += to_seconds(sources[1]) * raw.values[1];
    raw.values.erase(raw.values.begin() + 1);
    sources.erase(sources.begin() + 1);
    is_assumed = false;
  }
  if (const auto unit = is_assumed ? EpochUnit(time) : std::nullopt) {
    time *= unit->factor;
    if (unit->name != "s") {
      raw.notes.push_back(fmt::format("time counts {} since 1970 by its size", unit->name));
    }
    is_assumed = false;
  }
  sources.front().unit = FindUnit("s", {"s"}, "time", {raw.file});
  return is_assumed;
}

/// Makes time increase where the clock is coarse or made a slip.
void TakeClock(RawColumns& raw) {
  const MendedClock mended = MendClock(raw.values[1], raw.stamps, raw.values.front());
  if (!mended.note.empty()) raw.notes.push_back(mended.note);
  if (mended.left_out.empty()) return;
  std::vector<bool> keep(static_cast<std::size_t>(raw.values.front().size()), true);
  for (const Eigen::Index i : mended.left_out) keep[static_cast<std::size_t>(i)] = false;
  Keep(keep, raw);
}

/// Says which units the file tells: those of a row, and those of names that are not the usual ones.
void NoteUnits(const std::vector<ColumnSource>& sources, const ReadSettings& layout,
               RawColumns& raw) {
  std::vector<std::string> told;
  for (const auto& [column, index, unit, from, found_as, is_added] : sources) {
    const bool is_usual = unit.name == column->Units(layout.joint).front();
    const bool is_told = from == UnitFrom::given || (from == UnitFrom::name && !is_usual);
    const bool is_said = layout.unit.contains(column->name) || is_added || !found_as.empty();
    if (is_told && !is_said) told.push_back(fmt::format("{} {}", column->name, unit.name));
  }
  if (!told.empty())
    raw.notes.push_back(fmt::format("units of the file: {}", fmt::join(told, ", ")));
}

}  // namespace

Measurements AssembleMeasurements(RawColumns raw, std::vector<ColumnSource> sources,
                                  const ReadSettings& layout) {
  // what is known beside the columns
  CheckReadSettings(layout);
  Measurements measurements;
  measurements.joint = layout.joint;
  measurements.gear = layout.gear;
  measurements.source = raw.file;

  // the samples that have all numbers, and their time
  NoteUnits(sources, layout, raw);
  LeaveOutColumns(raw, sources);
  if (layout.rate > 0) {
    const Eigen::Index n = raw.values.front().size();
    sources.insert(sources.begin(), {&RecordingColumns().front(), 0, {"s", "s"}, UnitFrom::given});
    raw.values.insert(raw.values.begin(),
                      Eigen::VectorXd::LinSpaced(n, 0, static_cast<double>(n - 1)) / layout.rate);
  }
  LeaveOutRows(raw, sources);
  for (std::size_t k = 0; k < sources.size(); ++k) {
    CheckValues(raw, sources[k].column->name, raw.values[k]);
  }
  const bool is_assumed = TakeTime(raw, sources, layout);
  TakeClock(raw);

  // to SI
  double range = 0;  // after which the position sensor starts again, rad or m
  for (std::size_t k = 0; k < sources.size(); ++k) {
    const ColumnSource& source = sources[k];
    const RecordingColumn* const column = source.column;
    const Unit& unit = source.unit;
    Eigen::VectorXd values = std::move(raw.values[k]);
    const double scale = ScaleOf(column->name, layout);
    if (unit.factor != 1 || unit.offset != 0 || scale != 1) {
      values = unit.factor * scale * values.array() + unit.offset;
    }
    // the range of the sensor, in the unit of the position
    if (column->name == "position") range = std::abs(unit.factor * scale) * layout.wrap;
    if (column->name == "torque") measurements.torque_unit = unit.base;
    column->set(measurements, std::move(values));
    if (!source.found_as.empty()) {
      measurements.notes.push_back(
          fmt::format("{} from the column '{}'", column->name, Excerpt(source.found_as)));
    }
  }

  // all of it at once: at least three samples, in order, with a torque that changes
  std::ranges::move(raw.notes, std::back_inserter(measurements.notes));
  CheckCourse(raw, is_assumed, measurements);
  if (measurements.position.size() == 0 && measurements.velocity.size() == 0) {
    Refuse({raw.file}, "has neither a position nor a velocity with numbers; one is needed");
  }
  if (measurements.position.size() == 0) {
    IntegrateVelocity(measurements);
  } else {
    Unwrap(range, measurements);
    NoteSpeed(sources, measurements);
  }
  return measurements;
}

std::vector<std::string> NamesOf(const FileContent& content) {
  std::vector<std::string> names;
  for (const FileColumn& column : content.columns) names.push_back(column.name);
  return names;
}

ReadSettings WithAttributes(ReadSettings layout, const FileContent& content, const Place& place) {
  // what the file says of itself, where nobody says otherwise
  if (content.joint == "linear") layout.joint = JointKind::linear;
  if (layout.gear == 1 && content.gear) layout.gear = *content.gear;
  const std::vector<std::string> names = NamesOf(content);
  for (const RecordingColumn& column : RecordingColumns()) {
    const std::size_t found = FindColumn(column, names, layout, place);
    if (found == names.size() || content.columns[found].unit.empty()) continue;
    layout.unit.emplace(column.name, content.columns[found].unit);
  }
  return layout;
}

Measurements AssembleContent(const FileContent& content, const std::string& path,
                             const ReadSettings& given) {
  const ReadSettings layout = WithAttributes(given, content);
  const std::vector<ColumnSource> sources = FindColumns(NamesOf(content), layout, {path});
  // the columns that are asked for, all of one length
  RawColumns raw;
  raw.file = path;
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
