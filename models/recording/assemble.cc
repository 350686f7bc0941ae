#include "models/recording/assemble.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "models/foundation/excerpt.h"
#include "models/recording/clock.h"
#include "models/recording/measurements.h"
#include "models/recording/mend.h"
#include "models/recording/one_clock.h"

namespace warmjoint {
namespace {

constexpr double kLargest = 1e30;       // of any value; beyond it squares and products overflow
constexpr double kShortestStep = 1e-9;  // s, on average
// rad; why: a joint with stops turns twice each way, 25 rad from one end to the other, and in degrees a stroke of 1.75 rad is longer
constexpr double kFar = 100;
// rad/s; why: the fastest joints of robots reach 1,200 deg/s, 21 rad/s, and in degrees 1.05 rad/s, which most reach, is faster
constexpr double kFast = 60;
constexpr double kSpan = 0.1;        // s; why: noise of a position would have to be that of 6 rad
constexpr double kMostOften = 0.98;  // of the spans; why: a few spikes of a sensor are no motion
constexpr double kTurnsBack = 0.01;  // of the range; why: noise is less, a stroke is more

constexpr const char* kOfStamps =
    ", and no stamp as 2024-03-01T12:00:00.5, 12:00:00.5 or '0.5 s'; give one of these, or --rate "
    "HZ";
constexpr const char* kOfVoltage =
    "torque is a voltage, which drives the motor against its back-EMF, too: viscous holds that";

/// What messages call a column.
const std::string& NameOf(const ColumnSource& source) {
  return source.label.empty() ? source.column->name : source.label;
}

void CheckValues(const RawColumns& raw) {
  for (const ColumnSource& one : raw.columns) {
    // NaN fails the comparison too
    for (Eigen::Index i = 0; i < one.values.size(); ++i) {
      if (std::abs(one.values[i]) <= kLargest) continue;
      Refuse(
          raw.At(i),
          "{} of sample {} is {}; it must be a finite number of size {} at most. Cut the log there "
          "or repair it",
          NameOf(one), i + 1, one.values[i], kLargest);
    }
  }
}

/// Throws BadInput where time does not increase from sample to sample.
void CheckOrder(const RawColumns& raw, const Eigen::VectorXd& time) {
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
}

/// assumed: where nobody says the unit of time
void CheckUnitOfTime(const RawColumns& raw, const std::optional<AssumedUnit>& assumed,
                     Measurements& measurements) {
  if (assumed) return CheckAssumedUnit(*assumed, {raw.file}, measurements);
  // steps that are far too short tell of another unit
  const Eigen::VectorXd& time = measurements.time;
  const Eigen::Index n = time.size();
  const double step = (time[n - 1] - time[0]) / static_cast<double>(n - 1);
  if (step >= kShortestStep) return;
  Refuse(
      {raw.file},
      "samples are {:.4g} s apart; give the unit of time: --unit time=ns, us, ms, s, min, h or d",
      step);
}

/// The longest way in one direction, rad: a stroke ends where the joint turns back by kTurnsBack of its range.
double LongestStroke(const Eigen::VectorXd& position) {
  const double back = kTurnsBack * (position.maxCoeff() - position.minCoeff());
  double longest = 0;
  // both directions: forwards from the lowest place since the last turn, and backwards from the highest
  for (const double sign : {1.0, -1.0}) {
    double start = sign * position[0], end = start;
    for (const double p : position) {
      const double at = sign * p;
      if (at < end - back || at < start) start = end = at;
      end = std::max(end, at);
      longest = std::max(longest, end - start);
    }
  }
  return longest;
}

/// The speed that nearly all spans of kSpan, or of one sample where that is longer, stay below, rad/s.
double FastestTurning(const Eigen::VectorXd& time, const Eigen::VectorXd& position) {
  const auto samples = static_cast<Eigen::Index>(kSpan / MedianStep(time));
  const Eigen::Index count = time.size() - std::clamp<Eigen::Index>(samples, 1, time.size() - 1);
  Eigen::VectorXd speeds = (position.tail(count) - position.head(count)).cwiseAbs();
  speeds.array() /= (time.tail(count) - time.head(count)).array();
  return QuantileInPlace(speeds, kMostOften);
}

/// Asks for the unit where a joint moves as one does whose degrees were taken for radians, unless somebody says the unit of
/// `column`, from which its positions come, or the gear of a motor, which may move so.
void AskForAngles(const std::string& column, UnitFrom unit_from, const ReadSettings& layout,
                  Measurements& measurements) {
  const auto scale = layout.scale.find(column);
  const bool is_scaled = scale != layout.scale.end() && std::abs(scale->second) != 1;
  const bool is_said = unit_from != UnitFrom::nobody || is_scaled || measurements.gear != 1;
  if (is_said || layout.joint != JointKind::rotary) return;
  const double stroke = LongestStroke(measurements.position);
  const double fastest = FastestTurning(measurements.time, measurements.position);
  if (stroke <= kFar && fastest <= kFast) return;
  AddDoubt(
      fmt::format("the joint travels {:.4g} rad in one direction and turns at {:.4g} rev/min, and "
                  "no unit is given: "
                  "if these are degrees give --unit position=deg,velocity=deg/s, else "
                  "--unit position=rad or --gear",
                  stroke, fastest * 30 / std::numbers::pi),
      measurements);
}

void CheckTorque(const RawColumns& raw, const std::string& name, const Measurements& measurements) {
  const Eigen::VectorXd& torque = measurements.torque;
  if (torque.size() == 0 || torque.maxCoeff() > torque.minCoeff()) return;
  Refuse({raw.file}, "{} is {} {} in all {} samples; is it the right column (--map torque=NAME)?",
         name, torque[0], measurements.torque_unit, torque.size());
}

/// Number of samples.
void CheckCount(const RawColumns& raw, const Measurements& measurements) {
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

/// Position without the jumps of a sensor that starts its turn, or its range, again. range: rad or
/// m; 0: a turn, of a rotary joint.
void Unwrap(double range, Measurements& measurements) {
  // a linear sensor has no turn
  if (range == 0 && measurements.joint != JointKind::rotary) return;
  // by the range that is given, else by turns, with the speed to tell jumps from motion
  const int jumps =
      UndoJumps(measurements.time, measurements.velocity, range, measurements.position);
  if (jumps == 0) return;
  measurements.notes.push_back(fmt::format("position jumps by {} {} times; unwrapped",
                                           range > 0 ? "its range" : "a turn", jumps));
}

/// The first source of a column of ours; nullptr where there is none.
const ColumnSource* SourceOf(const RawColumns& raw, std::string_view name) {
  const auto found =
      std::ranges::find(raw.columns, name, [](const auto& one) { return one.column->name; });
  return found == raw.columns.end() ? nullptr : &*found;
}

/// Keeps the samples for which `keep` holds: [N].
void Keep(const std::vector<bool>& keep, RawColumns& raw) {
  const auto keep_in = [&keep](auto& values) {
    // each behind those that were kept before
    auto value = values.begin(), next = value;
    for (const bool kept : keep) {
      if (kept) *next++ = *value;
      ++value;
    }
    return next - values.begin();
  };
  for (ColumnSource& one : raw.columns) one.values.conservativeResize(keep_in(one.values));
  if (!raw.line.empty()) raw.line.resize(static_cast<std::size_t>(keep_in(raw.line)));
}

/// Leaves out optional columns that lack more numbers than they have: that loses less than the samples would.
void LeaveOutColumns(RawColumns& raw) {
  std::erase_if(raw.columns, [&](const ColumnSource& one) {
    const Eigen::Index lacking = one.values.array().isNaN().count();
    if (one.column->required || 2 * lacking <= one.values.size()) return false;
    raw.notes.push_back(fmt::format("{} is left out: it has no number in {} of {} rows",
                                    one.column->name, lacking, one.values.size()));
    return true;
  });
}

/// Leaves out the samples that lack a number in one of the first `count` columns.
void LeaveOutRows(std::size_t count, RawColumns& raw) {
  std::vector<bool> keep(static_cast<std::size_t>(raw.columns.front().values.size()), true);
  std::vector<std::string> lacking;
  for (const ColumnSource& one : std::span(raw.columns).first(count)) {
    if (!one.values.array().isNaN().any()) continue;
    lacking.push_back(NameOf(one));
    for (Eigen::Index i = 0; i < one.values.size(); ++i) {
      if (std::isnan(one.values[i])) keep[static_cast<std::size_t>(i)] = false;
    }
  }
  if (lacking.empty()) return;
  const auto left_out = std::ranges::count(keep, false);
  if (left_out == static_cast<std::ptrdiff_t>(keep.size())) {
    Refuse({raw.file},
           "has no row with a number for each of {}, and too few numbers to put them on one clock; "
           "record "
           "longer, or --map columns that hold numbers",
           fmt::join(lacking, ", "));
  }
  raw.notes.push_back(fmt::format("{} of {} rows lack a number ({}) and are left out", left_out,
                                  keep.size(), fmt::join(lacking, ", ")));
  Keep(keep, raw);
}

/// Makes the sum of the first two sources the first, in s.
void AddSecond(RawColumns& raw) {
  ColumnSource& first = raw.columns.front();
  const auto second = raw.columns.begin() + 1;
  if (second->unit_from == UnitFrom::nobody && !second->in_words) {
    Refuse(
        {raw.file},
        "--map time=A+B: the name of the second column must tell its unit, as nsecs or stamp_ns");
  }
  const auto factor = [](const ColumnSource& one) { return one.in_words ? 1 : one.unit.factor; };
  first.values = factor(first) * first.values + factor(*second) * second->values;
  first.unit = *MeantUnit("s");
  raw.columns.erase(second);
}

/// Leaves out rows at either end that are not on the clock.
void LeaveOutStrayRows(RawColumns& raw) {
  const Eigen::VectorXd& time = raw.columns.front().values;
  const StrayRows stray = FindStrayRows(time);
  if (stray.note.empty()) return;
  std::vector<bool> keep(static_cast<std::size_t>(time.size()), true);
  keep.front() = !stray.first;
  keep.back() = !stray.last;
  raw.notes.push_back(stray.note);
  Keep(keep, raw);
}

/// Makes the first source the time in s, of a rate or of one or two columns. Its unit, where nobody says that.
std::optional<AssumedUnit> TakeTime(const ReadSettings& layout, RawColumns& raw) {
  ColumnSource& first = raw.columns.front();
  const bool is_sum = raw.columns[1].is_added;
  const bool is_stamp = first.in_words;
  const bool is_assumed =
      first.unit_from == UnitFrom::nobody && !is_stamp && !is_sum && !layout.scale.contains("time");
  // a clock that goes on, and what is on it
  if (is_sum) AddSecond(raw);
  const std::string restarts = is_stamp || is_sum ? std::string() : UndoRestarts(first.values);
  if (!restarts.empty()) raw.notes.push_back(restarts);
  if (is_stamp) GoOnAtMidnight(first.values);
  LeaveOutStrayRows(raw);

  // stamps were read as s
  std::optional<AssumedUnit> assumed;
  if (is_assumed) assumed = AssumeUnit(first.values);
  if (assumed) first.unit = assumed->unit;
  if (!is_stamp) first.values *= first.unit.factor;
  first.unit = *MeantUnit("s");
  return assumed;
}

/// Makes time increase where the clock is coarse or made a slip.
void MendTicks(RawColumns& raw) {
  const ColumnSource* const position = SourceOf(raw, "position");
  const MendedClock mended =
      MendClock(position ? position->values : Eigen::VectorXd(), raw.columns.front().values);
  if (!mended.note.empty()) raw.notes.push_back(mended.note);
  if (!mended.keep.empty()) Keep(mended.keep, raw);
}

/// The time of a rate, in front of the other columns.
void AddTime(double rate, RawColumns& raw) {
  const Eigen::Index n = raw.columns.front().values.size();
  ColumnSource time{.column = &RecordingColumns().front(), .unit_from = UnitFrom::option};
  time.unit = *MeantUnit("s");
  time.values = Eigen::VectorXd::LinSpaced(n, 0, static_cast<double>(n - 1)) / rate;
  raw.columns.insert(raw.columns.begin(), std::move(time));
}

}  // namespace

void NoteUnits(const ReadSettings& layout, RawColumns& raw) {
  std::vector<std::string> told;
  for (const ColumnSource& one : raw.columns) {
    const std::string& name = one.column->name;
    const bool is_row = one.unit_from == UnitFrom::file && !raw.line.empty();
    const bool is_usual = one.unit.name == one.column->Units(layout.joint).front();
    const bool is_said = layout.unit.contains(name) || one.is_added || !one.found_as.empty();
    const std::string words = fmt::format("{} {}", name, one.unit.name);
    const bool is_new = std::ranges::find(told, words) == told.end();
    if ((is_row || !is_usual) && !is_said && is_new) told.push_back(words);
  }
  if (!told.empty()) {
    raw.notes.push_back(fmt::format("units of the file: {}", fmt::join(told, ", ")));
  }
}

Measurements AssembleMeasurements(RawColumns raw, const ReadSettings& layout) {
  CheckReadSettings(layout);
  // the samples that have all numbers, and their time
  NoteUnits(layout, raw);
  JoinRows(raw);
  LeaveOutColumns(raw);
  if (layout.rate > 0) AddTime(layout.rate, raw);
  LeaveOutRows(raw.columns.size(), raw);
  CheckValues(raw);
  const std::optional<AssumedUnit> assumed = TakeTime(layout, raw);
  MendTicks(raw);
  const ColumnSource* const velocity = SourceOf(raw, "velocity");
  const UnitFrom of_velocity = velocity ? velocity->unit_from : UnitFrom::nobody;
  Measurements measurements = AssembleOnClock(std::move(raw), assumed, layout);
  if (measurements.position.size() == 0 && measurements.velocity.size() == 0) {
    Refuse({measurements.source},
           "has neither a position nor a velocity with numbers; one is needed");
  }
  if (measurements.position.size() == 0) {
    IntegrateVelocity(measurements);
    AskForAngles("velocity", of_velocity, layout, measurements);
  }
  return measurements;
}

std::optional<AssumedUnit> TakeClock(const ReadSettings& layout, RawColumns& raw) {
  CheckReadSettings(layout);
  if (layout.rate > 0) AddTime(layout.rate, raw);
  // the clock's own columns alone: others lack numbers where they like
  const std::size_t of_time = raw.columns[1].is_added ? 2 : 1;
  LeaveOutRows(of_time, raw);
  RawColumns clock{raw.file, {raw.columns.begin(), raw.columns.begin() + of_time}, raw.line};
  CheckValues(clock);
  const std::optional<AssumedUnit> assumed = TakeTime(layout, raw);
  MendTicks(raw);
  CheckOrder(raw, raw.columns.front().values);
  return assumed;
}

Measurements AssembleOnClock(RawColumns raw, const std::optional<AssumedUnit>& assumed,
                             const ReadSettings& layout) {
  Measurements measurements;
  measurements.joint = layout.joint;
  measurements.gear = layout.gear;
  measurements.source = raw.file;
  LeaveOutRows(raw.columns.size(), raw);
  CheckValues(raw);

  // to SI
  double range = 0;  // after which the position sensor starts again, rad or m
  for (ColumnSource& one : raw.columns) {
    const std::string& name = one.column->name;
    const auto scale = layout.scale.find(name);
    const double factor = one.unit.factor * (scale == layout.scale.end() ? 1 : scale->second);
    if (factor != 1 || one.unit.offset != 0) {
      one.values = factor * one.values.array() + one.unit.offset;
    }
    // the range of the sensor, in the unit of the position
    if (name == "position") range = std::abs(factor) * layout.wrap;
    if (name == "torque") measurements.torque_unit = one.unit.base;
    if (name == "position") measurements.other_joints = std::move(one.of_other_joints);
    one.column->set(measurements, std::move(one.values));
    if (!one.found_as.empty()) {
      measurements.notes.push_back(
          fmt::format("{} from the column '{}'", name, Excerpt(one.found_as)));
    }
  }

  // all of it at once: at least three samples, in a unit of time that can be, with a torque that changes
  std::ranges::move(raw.notes, std::back_inserter(measurements.notes));
  std::ranges::move(raw.doubts, std::back_inserter(measurements.doubts));
  CheckCount(raw, measurements);
  CheckOrder(raw, measurements.time);
  CheckUnitOfTime(raw, assumed, measurements);
  if (const ColumnSource* const torque = SourceOf(raw, "torque")) {
    CheckTorque(raw, NameOf(*torque), measurements);
  }
  if (measurements.torque_unit == "V") measurements.notes.emplace_back(kOfVoltage);
  if (measurements.position.size() == 0) return measurements;
  Unwrap(range, measurements);
  const ColumnSource& position = *SourceOf(raw, "position");
  AskForAngles("position", position.unit_from, layout, measurements);
  return measurements;
}

ReadSettings WithJointOf(const FileContent& content, ReadSettings layout) {
  if (content.joint == "linear") layout.joint = JointKind::linear;
  if (layout.gear == 1 && content.gear) layout.gear = *content.gear;
  return layout;
}

ReadSettings WithClock(const std::vector<FileColumn>& columns, ReadSettings layout,
                       const Place& place) {
  // any rate: MakeHolds makes the time
  if (IsTableOfSpeeds(columns, layout, place)) layout.rate = 1;
  return layout;
}

Measurements OnlyOne(std::vector<Measurements> recordings) {
  if (recordings.size() == 1) return std::move(recordings.front());
  Refuse({recordings.front().source}, "holds {} episodes where one recording is needed; split it",
         recordings.size());
}

namespace {

/// Leaves out sentences that stand there already: what a file says of itself, and reading says again.
void SayOnce(std::vector<std::string>& sentences) {
  std::vector<std::string> kept;
  for (std::string& one : sentences) {
    if (std::ranges::find(kept, one) == kept.end()) kept.push_back(std::move(one));
  }
  sentences = std::move(kept);
}

}  // namespace

std::vector<Measurements> AssembleRecordings(RawColumns raw, const std::vector<FileColumn>& columns,
                                             const ReadSettings& layout) {
  const bool is_timed = raw.columns.front().column->name == RecordingColumns().front().name;
  if (!is_timed && layout.rate == 0) MakeHolds(raw);
  std::vector<Measurements> recordings;
  for (RawColumns& episode : Episodes(std::move(raw), columns)) {
    recordings.push_back(AssembleMeasurements(std::move(episode), layout));
    SayOnce(recordings.back().notes);
    SayOnce(recordings.back().doubts);
  }
  return recordings;
}

std::vector<Measurements> AssembleContent(FileContent content, const std::string& path,
                                          const ReadSettings& given) {
  const ReadSettings layout = WithJointOf(content, given);
  RawColumns raw{path,
                 FindColumns(content.columns, WithClock(content.columns, layout, {path}), {path})};
  TakeValues(content, path, raw.columns);
  raw.line = std::move(content.line);
  raw.notes = content.notes;
  raw.doubts = content.doubts;
  return AssembleRecordings(std::move(raw), content.columns, layout);
}

WantedColumns ColumnsOfJoint(const ReadSettings& layout) {
  return [layout](const FileContent& content, const Place& header, const std::string& there) {
    const ReadSettings asked = WithClock(content.columns, WithJointOf(content, layout), header);
    std::vector<WantedColumn> wanted;
    for (const ColumnSource& one : FindColumns(content.columns, asked, header, there)) {
      wanted.push_back({one.index, one.column == &RecordingColumns().front()});
    }
    return wanted;
  };
}

void TakeValues(FileContent& content, const std::string& path, std::vector<ColumnSource>& found) {
  const FileColumn* first = nullptr;
  Eigen::Index samples = 0;
  for (ColumnSource& one : found) {
    FileColumn& column = content.columns[one.index];
    const bool is_time = one.column == &RecordingColumns().front();
    if (!column.refusal.empty()) {
      throw BadInput(column.refusal + (is_time ? kOfStamps : ""));
    }
    if (!first) first = &column, samples = column.values.size();
    if (column.values.size() != samples) {
      Refuse({path}, "{} has {} samples where {} has {}; all columns must be of one length",
             Excerpt(column.name), column.values.size(), Excerpt(first->name), samples);
    }
    one.in_words = column.in_words;
    one.values = std::move(column.values);
  }
}

}  // namespace warmjoint
