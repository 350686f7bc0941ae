#include <fmt/format.h>
#include <warmjoint/prepared_log.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <utility>

#include "identification/preparation/log_faults.h"
#include "identification/preparation/moving_view.h"
#include "identification/preparation/transitions.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/robust_noise.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

using Eigen::Index;

constexpr Index kFewestSamples = 3;  // of a recording, as readers ask

LogView Head(const LogView& all, double time) {
  const Index n = (all.measurements.time.array() < time).count();
  LogView head{all.measurements, {all.selection.keep.head(n), {}}};
  ForEachColumn(head.measurements, [n](Eigen::VectorXd& column) {
    column.conservativeResize(std::min(n, column.size()));
  });
  for (Segment segment : all.selection.segments) {
    if (segment.begin >= n) break;
    segment.end = std::min(segment.end, n);
    head.selection.segments.push_back(segment);
  }
  std::erase_if(head.measurements.inserted, [n](Index one) { return one >= n; });
  return head;
}

// Several recordings.

/// Sentences about a recording, with the file that they are about.
std::vector<std::string> Named(const std::string& source, std::vector<std::string> sentences) {
  for (std::string& sentence : sentences) sentence = fmt::format("{}: {}", source, sentence);
  return sentences;
}

template <typename Column>
void Append(const Column& more, Column& column) {
  const Index n = column.size();
  column.conservativeResize(n + more.size());
  column.tail(more.size()) = more;
}

/// Columns that a recording may lack, by their names for people.
constexpr std::pair<std::optional<Eigen::VectorXd> LogSamples::*, const char*> kOptional[] = {
    {&Measurements::motor_position, "motor_position"},
    {&Measurements::load, "load"},
    {&Measurements::temperature, "temperature"},
    {&LogSamples::acceleration, "acceleration"},
    {&LogSamples::mean_speed, "mean_speed"},
    {&LogSamples::loss_velocity, "loss_velocity"}};

/// Appends a recording to others. step: s, between their last sample and its first
void Append(const LogView& next, double step, LogView& stack) {
  const LogSamples& more = next.measurements;
  LogSamples& all = stack.measurements;
  const Index n = all.size();
  all.further_starts.push_back(n);
  for (const Index one : more.inserted) all.inserted.push_back(one + n);
  all.source += " + " + more.source;
  std::ranges::move(Named(more.source, more.notes), std::back_inserter(all.notes));
  std::ranges::move(Named(more.source, more.doubts), std::back_inserter(all.doubts));
  // the columns; one that may be absent is gone where either lacks it
  Append<Eigen::VectorXd>(more.time.array() - more.time[0] + all.time[n - 1] + step, all.time);
  Append(more.position, all.position);
  Append(more.velocity, all.velocity);
  Append(more.torque, all.torque);
  all.position_integrated |= more.position_integrated;
  for (const auto& [column, name] : kOptional) {
    if (all.*column && more.*column) {
      Append(*(more.*column), *(all.*column));
    } else if (all.*column || more.*column) {
      all.notes.push_back(fmt::format("{} is left out: not every recording has it", name));
      (all.*column).reset();
    }
  }
  // the samples that take part in fits
  Append(next.selection.keep, stack.selection.keep);
  for (const Segment& segment : next.selection.segments) {
    stack.selection.segments.push_back({segment.begin + n, segment.end + n, segment.velocity});
  }
}

/// A view of each recording, one after the other.
template <typename View>
LogView StackOf(const std::vector<PreparedLog>& recordings, const View& view) {
  LogView stack = std::invoke(view, recordings.front());
  LogSamples& first = stack.measurements;
  first.notes = Named(first.source, std::move(first.notes));
  first.doubts = Named(first.source, std::move(first.doubts));
  for (size_t i = 1; i < recordings.size(); ++i) {
    const double step = MedianStep(recordings[i - 1].raw().measurements.time);
    Append(std::invoke(view, recordings[i]), step, stack);
  }
  return stack;
}

/// Leaves samples out of fits. samples: of those that were logged
void LeaveOut(const std::vector<Index>& samples, LogView& view) {
  const std::vector<Index> logged = view.measurements.Logged();
  for (const Index n : samples) {
    if (n < std::ssize(logged)) view.selection.keep[logged[static_cast<size_t>(n)]] = false;
  }
}

void CheckAlike(const Measurements& a, const Measurements& b) {
  if (a.torque_unit == b.torque_unit && a.joint == b.joint && a.gear == b.gear) return;
  Refuse({b.source},
         "is of another joint or in another unit ({}) than {} ({}); join recordings of "
         "one joint",
         b.torque_unit, a.source, a.torque_unit);
}

/// The velocity noise over all kept samples whose velocity was averaged: means, and the spread of their speeds within the
/// recordings and from one to the next.
std::optional<VelocityNoise> MeanNoise(const std::vector<PreparedLog>& recordings) {
  double count = 0, noise = 0, error = 0, speed = 0, square = 0;
  for (const PreparedLog& one : recordings) {
    const std::optional<VelocityNoise>& own = one.velocity_noise();
    if (!own) continue;
    const auto samples = static_cast<double>(one.constant_speed().selection.count());
    count += samples;
    noise += samples * own->noise * own->noise;
    error += samples * own->error * own->error;
    speed += samples * own->mean_speed;
    square += samples * (own->spread + own->mean_speed * own->mean_speed);
  }
  if (count == 0) return std::nullopt;
  VelocityNoise mean{.noise = std::sqrt(noise / count),
                     .mean_speed = speed / count,
                     .error = std::sqrt(error / count)};
  mean.spread = square / count - mean.mean_speed * mean.mean_speed;
  mean.FindShares();
  return mean;
}

/// The share of the whole path that no sample shows.
double UnresolvedPath(const std::vector<PreparedLog>& recordings) {
  double unresolved = 0, path = 0;
  for (const PreparedLog& one : recordings) {
    const double own = HeldPath(one.constant_speed().measurements);
    unresolved += one.unresolved_path() * own;
    path += own;
  }
  return path > 0 ? unresolved / path : 0;
}

}  // namespace

std::vector<SampleRange> LogSamples::Recordings() const { return CutAt(further_starts, size()); }

std::vector<Index> LogSamples::Logged() const {
  std::vector<Index> logged;
  auto next = inserted.begin();
  for (Index i = 0; i < size(); ++i) {
    if (next != inserted.end() && *next == i) {
      ++next;
    } else {
      logged.push_back(i);
    }
  }
  return logged;
}

PreparedLog::PreparedLog(Log log) {
  // whether speeds are held does not depend on --trim
  log.holds_speeds =
      log.holds_speeds || HoldsSpeeds(log.raw.measurements, log.raw.selection, log.source);
  log.without_absurd = LeaveOutAbsurd(log);
  log_ = std::make_shared<const Log>(std::move(log));
}

PreparedLog Join(std::vector<PreparedLog> recordings) {
  if (recordings.empty()) Refuse({}, "no recording is given");
  if (recordings.size() == 1) return recordings.front();
  PreparedLog::Log all;
  bool is_changed = false;
  for (const PreparedLog& one : recordings) {
    const Measurements& m = one.raw().measurements;
    CheckAlike(recordings.front().raw().measurements, m);
    is_changed |= one.log_->constant_speed.has_value();
    if (one.source() == MotionSource::positions) all.source = MotionSource::positions;
    for (const auto& [sentence, is_absurd] : one.log_->faults) {
      all.faults.push_back({fmt::format("{}: {}", m.source, sentence), is_absurd});
    }
    std::ranges::move(Named(m.source, one.warnings()), std::back_inserter(all.warnings));
    if (one.absurd()) {
      all.absurd = fmt::format("{}{}{}: {}", all.absurd.value_or(""), all.absurd ? "; " : "",
                               m.source, *one.absurd());
    }
  }
  all.holds_speeds = std::ranges::all_of(recordings, &PreparedLog::holds_speeds);
  all.raw = StackOf(recordings, &PreparedLog::raw);
  if (is_changed) all.constant_speed = StackOf(recordings, &PreparedLog::constant_speed);
  all.velocity_noise = MeanNoise(recordings);
  all.unresolved_path = UnresolvedPath(recordings);
  all.recordings = std::move(recordings);
  return PreparedLog(std::move(all));
}

const LogView& PreparedLog::moving() const {
  std::call_once(moving_->once, [this] { MakeMoving(*moving_); });
  return moving_->view;
}

const std::vector<std::string>& PreparedLog::moving_warnings() const {
  moving();
  return moving_->warnings;
}

void PreparedLog::MakeMoving(Moving& made) const {
  if (!log_->recordings.empty()) {
    made.view = StackOf(log_->recordings, &PreparedLog::moving);
    for (const PreparedLog& one : log_->recordings) {
      std::ranges::move(Named(one.raw().measurements.source, one.moving_warnings()),
                        std::back_inserter(made.warnings));
    }
    return;
  }
  FollowedMotion followed = FollowMotion(log_->raw.measurements, log_->source);
  made.view = std::move(followed.view);
  // why positions take the place of a column
  if (log_->source == MotionSource::positions) {
    std::ranges::copy_if(log_->warnings, std::back_inserter(made.warnings),
                         [&](const std::string& one) { return one != log_->absurd; });
  }
  if (!followed.done.empty()) made.warnings.push_back(std::move(followed.done));
  LeaveOut(log_->left_out, made.view);
}

std::vector<std::string> PreparedLog::faults() const {
  std::vector<std::string> sentences;
  for (const LogFault& fault : log_->faults) sentences.push_back(fault.sentence);
  return sentences;
}

PreparedLog PreparedLog::Before(double time) const {
  if (log_->recordings.empty()) {
    Log before = *log_;
    before.raw = Head(log_->raw, time);
    if (log_->constant_speed) before.constant_speed = Head(*log_->constant_speed, time);
    return PreparedLog(std::move(before));
  }
  // as many samples of each recording as are before it; fewer show no motion
  Index left = (log_->raw.measurements.time.array() < time).count();
  std::vector<PreparedLog> before;
  for (const PreparedLog& one : log_->recordings) {
    const Eigen::VectorXd& own = one.raw().measurements.time;
    if (left < kFewestSamples && !before.empty()) break;
    before.push_back(left < own.size() ? one.Before(own[left]) : one);
    left -= own.size();
  }
  return Join(std::move(before));
}

std::shared_ptr<const PreparedLog> PreparedLog::LeaveOutAbsurd(const Log& log) {
  // of several recordings each by itself
  if (!log.recordings.empty()) {
    const auto has_none = [](const PreparedLog& one) { return !one.log_->without_absurd; };
    if (std::ranges::all_of(log.recordings, has_none)) return nullptr;
    std::vector<PreparedLog> without;
    for (const PreparedLog& one : log.recordings) without.push_back(one.WithoutAbsurd());
    return std::make_shared<const PreparedLog>(Join(std::move(without)));
  }
  if (std::ranges::none_of(log.faults, &LogFault::is_absurd_torque)) return nullptr;
  const auto& [measurements, selection] = log.raw;
  const SampleMask absurd = AbsurdTorque(measurements, selection);
  if (!absurd.any()) return nullptr;

  // the fault becomes a warning
  Log without = log;
  std::erase_if(without.faults, [](const LogFault& fault) { return fault.is_absurd_torque; });
  without.absurd = fmt::format("{}, and left out", DescribeAbsurd(measurements, absurd));
  without.warnings.push_back(*without.absurd);
  for (Index i = 0; i < absurd.size(); ++i) {
    if (absurd[i]) without.left_out.push_back(i);
  }
  LeaveOut(without.left_out, without.raw);
  if (without.constant_speed) LeaveOut(without.left_out, *without.constant_speed);
  return std::make_shared<const PreparedLog>(PreparedLog(std::move(without)));
}

}  // namespace warmjoint
