#include "identification/preparation/transitions.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "models/foundation/robust_noise.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// SplitAtSwitches
constexpr double kLeastChange = 0.1;  // of the velocity's rms
constexpr double kSteady =
    0.25;  // of the change, before and after it; why: with 0.17 or 0.38 64 logs are covered as well
constexpr double kInside = 1e-6;  // of an interval: a switch nearer to a sample is at it

// ComparePaths
constexpr double kHarmless = 1e-3;  // of the path
constexpr double kCertain = 4;      // standard errors
constexpr double kNoMatter = 1e-4;  // of a transition's length
constexpr int kFewest = 8;          // transitions

// ReplaceTransitions
constexpr double kBehind = 1e-6;  // of a step

/// The column with a value for each sample put in, a copy of the value after it. [N + inserted]
template <typename Column>
Column Filled(const Column& column, const std::vector<InsertedSample>& inserted) {
  Column filled(column.size() + static_cast<Index>(inserted.size()));
  Index from = 0, to = 0;
  // all up to the sample in front, then a copy of the one after it
  for (const InsertedSample& one : inserted) {
    const Index count = one.after + 1 - from;
    filled.segment(to, count) = column.segment(from, count);
    from += count;
    to += count;
    filled[to++] = column[from];
  }
  filled.tail(filled.size() - to) = column.tail(column.size() - from);
  return filled;
}

/// Whether the change of speed after sample n is a single step, not part of a ramp that the samples show.
bool StandsAlone(const VectorXd& v, Index n) {
  const double before = n > 0 ? std::abs(v[n] - v[n - 1]) : 0;
  const double behind = n + 2 < v.size() ? std::abs(v[n + 2] - v[n + 1]) : 0;
  return std::max(before, behind) <= kSteady * std::abs(v[n + 1] - v[n]);
}

/// The path since the first sample, as a function of time.
class Path {
 public:
  explicit Path(const Measurements& m) : m_(m), until_(m.size()) {
    until_[0] = 0;
    // path until each sample, its velocity held until the next
    for (Index i = 0; i + 1 < m.size(); ++i) {
      until_[i + 1] = until_[i] + std::abs(m.velocity[i]) * (m.time[i + 1] - m.time[i]);
    }
  }

  double Between(double from, double to) const { return At(to) - At(from); }

 private:
  double At(double time) const {
    const double* begin = m_.time.data();
    const auto behind = std::upper_bound(begin, begin + m_.size(), time) - begin;
    // the path until the sample in front, and its velocity from there on
    const Index i = std::max<Index>(behind - 1, 0);
    return until_[i] + std::abs(m_.velocity[i]) * (time - m_.time[i]);
  }

  const Measurements& m_;
  VectorXd until_;  // [N] rad or m
};

/// The samples that a version of a log puts in.
std::vector<InsertedSample> InsertedIn(const LogSamples& log) {
  std::vector<InsertedSample> inserted;
  for (const Index i : log.inserted) {
    const Index logged = i - std::ssize(inserted);  // samples in front of it
    inserted.push_back({logged - 1, log.time[i], log.position[i], log.velocity[i]});
  }
  return inserted;
}

/// Which samples lie on a transition whose two versions differ by no more than sampling explains. [N]
SampleMask OnTransitions(const std::vector<Transition>& transitions, const VectorXd& velocity,
                         const VectorXd& time) {
  SampleMask on = SampleMask::Constant(time.size(), false);
  const double step = MedianStep(time);
  for (const Transition& one : transitions) {
    // sampling misplaces a change of speed by a step at most
    const double change = std::abs(velocity[one.last] - velocity[one.first]);
    if (std::abs(one.difference) > step * change) continue;
    on.segment(one.first, one.last - one.first).setConstant(true);
  }
  return on;
}

}  // namespace

void InsertSamples(const std::vector<InsertedSample>& inserted, LogView& view) {
  auto& [log, selection] = view;
  const Eigen::VectorXd position = log.position;
  const auto motor = log.motor_position;
  ForEachColumn(log, [&](Eigen::VectorXd& column) { column = Filled(column, inserted); });
  selection.keep = Filled(selection.keep, inserted);

  // the samples that are put in: their times and places, and that they are not fitted
  for (size_t i = 0; i < inserted.size(); ++i) {
    const InsertedSample& one = inserted[i];
    const Index n = one.after + 1 + static_cast<Index>(i);
    log.inserted.push_back(n);
    log.time[n] = one.time;
    log.position[n] = one.position;
    log.velocity[n] = one.velocity;
    selection.keep[n] = false;
    if (!motor) continue;
    (*log.motor_position)[n] =
        (*motor)[one.after] + log.gear * (one.position - position[one.after]);
  }

  // the new places of the samples that were taken
  const auto moved = [&](Index n) {
    const auto behind = std::ranges::lower_bound(inserted, n, {}, &InsertedSample::after);
    return n + (behind - inserted.begin());
  };
  for (Segment& segment : selection.segments) {
    segment.begin = moved(segment.begin);
    segment.end = moved(segment.end);
  }
}

double UnresolvedAt(double v0, double v1, double nearer) {
  return v0 * v1 < 0 ? 2 * nearer * std::abs(v0 * v1 / (v0 - v1)) : 0;
}

double HeldPath(const Measurements& m) {
  const Index steps = m.size() - 1;
  return m.velocity.head(steps).cwiseAbs().dot(m.time.tail(steps) - m.time.head(steps));
}

std::optional<FilledLog> SplitAtSwitches(const LogView& log) {
  const Measurements& m = log.measurements;
  const double rms = std::sqrt(m.velocity.squaredNorm() / static_cast<double>(m.size()));
  const double longest = LongestStep(m.time);
  std::vector<InsertedSample> switches;
  double unresolved = 0;
  for (Index n = 0; n + 1 < m.size(); ++n) {
    const double v0 = m.velocity[n], v1 = m.velocity[n + 1];
    const double h = m.time[n + 1] - m.time[n];
    if (std::abs(v1 - v0) <= kLeastChange * rms || h > longest) continue;
    // one step changes the speed, those around it do not
    if (!StandsAlone(m.velocity, n)) continue;
    // v0 until the switch and v1 after it must make the distance between the samples
    const double s = (m.position[n + 1] - m.position[n] - v1 * h) / (v0 - v1);
    if (!(s > kInside * h && s < (1 - kInside) * h)) continue;
    switches.push_back({n, m.time[n] + s, m.position[n] + s * v0, v1});
    unresolved += UnresolvedAt(v0, v1, std::min(s, h - s));
  }
  if (switches.empty()) return std::nullopt;
  const double path = HeldPath(m);
  FilledLog split{log, path > 0 ? unresolved / path : 0};
  InsertSamples(switches, split.view);
  return split;
}

std::optional<PathComparison> ComparePaths(const Measurements& by_velocity,
                                           const Measurements& by_position,
                                           const std::vector<Segment>& segments,
                                           const Measurements& taken) {
  const Path velocity(by_velocity), position(by_position);
  const Eigen::VectorXd& time = taken.time;
  // a segment along which both have the same speed
  const auto is_same_speed = [&](const Segment& segment) {
    const double from = time[segment.begin], to = time[segment.end - 1];
    const double by_column = velocity.Between(from, to), path = position.Between(from, to);
    return std::abs(by_column - path) <= kSameSpeed * path;
  };
  const auto middle = [](const Segment& segment) { return (segment.begin + segment.end - 1) / 2; };
  const std::vector<SampleRange> pieces = PiecesOf(time);

  PathComparison paths;
  double path = 0, sum = 0;
  for (size_t i = 0; i + 1 < segments.size(); ++i) {
    const Index first = middle(segments[i]), last = middle(segments[i + 1]);
    if (!is_same_speed(segments[i]) || !is_same_speed(segments[i + 1])) continue;
    if (PieceAt(pieces, first).end() <= last) continue;  // a gap lies between
    const double length = position.Between(time[first], time[last]);
    const double difference = velocity.Between(time[first], time[last]) - length;
    paths.transitions.push_back({first, last, length, difference});
    sum += difference;
    path += length;
  }
  const auto n = static_cast<double>(paths.transitions.size());
  if (n < kFewest || path == 0) return std::nullopt;

  // standard error of the mean difference, from its spread over the transitions
  double squares = 0;
  for (const Transition& one : paths.transitions) squares += std::pow(one.difference - sum / n, 2);
  paths.excess = sum / path;
  paths.error = std::sqrt(squares / (n - 1) * n) / path;
  return paths;
}

bool Contradicts(const PathComparison& paths) {
  return std::abs(paths.excess) > std::max(kHarmless, kCertain * paths.error);
}

bool PositionsTellMore(const PathComparison& paths, double deviation) {
  double squares = 0, length = 0;
  for (const Transition& one : paths.transitions) {
    squares += one.difference * one.difference;
    length += one.length;
  }
  const auto n = static_cast<double>(paths.transitions.size());
  const double least = std::max(8 * deviation * deviation, std::pow(kNoMatter * length / n, 2));
  return squares / n > least;
}

LogView ReplaceTransitions(const LogView& taken, const LogSamples& by_velocity,
                           const LogSamples& by_position,
                           const std::vector<Transition>& transitions) {
  const auto& [m, selection] = taken;
  const VectorXd velocity = by_velocity.velocity(by_velocity.Logged()),
                 position = by_position.velocity(by_position.Logged());
  const SampleMask on = OnTransitions(transitions, velocity, m.time);

  // the samples that each version puts in where it is used, but none within a segment
  std::set<Index> begins;
  for (const Segment& segment : selection.segments) begins.insert(segment.begin);
  const auto is_within = [&](Index n) {
    return selection.keep[n] && selection.keep[n + 1] && !begins.contains(n + 1);
  };
  std::vector<InsertedSample> inserted;
  const auto add = [&](const LogSamples& version, bool here) {
    for (const InsertedSample& one : InsertedIn(version)) {
      if (on[one.after] == here && !is_within(one.after)) inserted.push_back(one);
    }
  };
  add(by_velocity, false);
  add(by_position, true);

  // the speeds of the samples; right after the last of a segment the speed changes
  LogView log = taken;
  for (Index n = 0; n < m.size(); ++n) {
    const bool changes = on[n] && !selection.keep[n];
    log.measurements.velocity[n] = (changes ? position : velocity)[n];
    // where the positions are used, a segment ends right after its last sample
    if (!on[n] || changes || n + 1 == m.size() || selection.keep[n + 1]) continue;
    const double behind = m.time[n] + kBehind * (m.time[n + 1] - m.time[n]);
    inserted.push_back({n, behind, m.position[n], position[n]});
  }
  std::ranges::sort(inserted, {}, &InsertedSample::time);
  InsertSamples(inserted, log);
  return log;
}

}  // namespace warmjoint
