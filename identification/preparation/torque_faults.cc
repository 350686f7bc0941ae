#include <fmt/format.h>
#include <warmjoint/recording.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "identification/preparation/log_faults.h"
#include "identification/preparation/moving_view.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr Index kLongRun = 20;  // kept samples of one torque; why 20: noise gives none

/// Samples in a row with exactly one torque.
struct ConstantRun {
  Index begin = 0, end = 0;  // first sample, one past the last
  Index kept = 0;            // of them, how many are kept
};

/// Figures of the torque from neighbouring samples that are both kept. Long runs do not count in the shares.
struct TorqueNoiseStatistics {
  double equal = 0;  // share of the neighbours that differ by 1e-6 of the largest |torque| at most
  double turning = 0;  // share of the samples above or below both neighbours; 2/3 in white noise
  std::vector<ConstantRun> long_runs;  // that keep kLongRun samples or more

  /// Whether torque goes up and down as noise does; a smooth one and one in steps do not.
  bool IsNoisy() const { return turning > 0.2; }
};

std::vector<ConstantRun> LongRuns(const VectorXd& torque, const Selection& selection) {
  std::vector<ConstantRun> runs;
  for (Index begin = 0, end = 0; begin < torque.size(); begin = end) {
    end = begin + 1;
    while (end < torque.size() && torque[end] == torque[begin]) ++end;
    if (end - begin < kLongRun) continue;
    // only samples that a fit uses count
    const Index kept = selection.keep.segment(begin, end - begin).count();
    if (kept >= kLongRun) runs.push_back({begin, end, kept});
  }
  return runs;
}

double Share(Index part, Index whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0;
}

TorqueNoiseStatistics MeasureTorqueNoise(const Measurements& measurements,
                                         const Selection& selection) {
  const VectorXd& torque = measurements.torque;
  TorqueNoiseStatistics noise;
  noise.long_runs = LongRuns(torque, selection);

  // shares of equal steps and of turning points among kept neighbours
  const double rounding = 1e-6 * torque.cwiseAbs().maxCoeff();
  auto run = noise.long_runs.begin();
  Index pairs = 0, equal = 0, triples = 0, turning = 0;
  for (Index i = 1; i + 1 < torque.size(); ++i) {
    // long runs are judged by themselves
    if (run != noise.long_runs.end() && i >= run->begin) {
      i = run->end;
      ++run;
      continue;
    }
    if (!selection.keep[i] || !selection.keep[i + 1]) continue;
    const double step = torque[i + 1] - torque[i];
    ++pairs;
    equal += std::abs(step) <= rounding;
    // a turning point takes three samples in a row
    if (!selection.keep[i - 1]) continue;
    const double before = torque[i] - torque[i - 1];
    ++triples;
    turning += before * step < 0 && std::min(std::abs(before), std::abs(step)) > rounding;
  }
  noise.equal = Share(equal, pairs);
  noise.turning = Share(turning, triples);
  return noise;
}

// ClippedTorque
constexpr Index kPile = 10;            // samples at the extreme value
constexpr double kPileShare = 0.005;   // of the kept samples
constexpr Index kAboveNext = 5;        // times as many as at the next value
constexpr std::size_t kDistinct = 50;  // values

// StuckTorque
constexpr double kFewEqual = 0.05;    // of the steps
constexpr double kOtherSpeed = 0.05;  // of the largest |velocity| in a run

// DroppedTorque
constexpr Index kDrops = 5;
constexpr Index kRarer = 4;      // times rarer is what else is near 0
constexpr double kNear0 = 0.25;  // of the mean of |torque|

// AbsurdTorque, times the typical one
constexpr double kFarOff = 10;  // why: breakaway and heavy tails stay below in 99.9 %
constexpr double kAbsurd =
    50;  // of one sample; why: tails of 3 degrees of freedom go there once in a million
constexpr double kTransient = 2;  // times further where nothing holds a speed; why: inertia
constexpr double kMany = 0.01;    // of the samples; why: noise puts a tenth of that beyond kFarOff
constexpr Index kRun = 3;         // samples in a row; why: noise puts none there
constexpr Index kBins = 8;  // of speed; why: a quarter of the log owns fewer than half of them
constexpr Index kSameStretch = 10;  // samples; why: fewer between two make them no other event

/// Kept samples with the largest value of torque times `sign`.
struct Pile {
  double value = -kInfinity;  // sign * torque
  double next = -kInfinity;   // the value next to it
  Index samples = 0, at_next = 0;
  Index first = -1;  // sample
};

Pile FindPile(const Measurements& m, const Selection& selection, double sign) {
  Pile pile;
  for (Index i = 0; i < m.size(); ++i) {
    const double value = sign * m.torque[i];
    if (value < pile.next || !selection.keep[i]) continue;
    // samples at the largest value, and at the one next to it
    if (value > pile.value) {
      pile = {value, pile.value, 1, pile.samples, i};
    } else if (value == pile.value) {
      ++pile.samples;
    } else if (value > pile.next) {
      pile.next = value;
      pile.at_next = 1;
    } else {
      ++pile.at_next;
    }
  }
  return pile;
}

bool TakesManyValues(const Measurements& m, const Selection& selection) {
  std::vector<double> values;
  for (Index i = 0; i < m.size() && values.size() < kDistinct; ++i) {
    if (!selection.keep[i] || std::ranges::find(values, m.torque[i]) != values.end()) continue;
    values.push_back(m.torque[i]);
  }
  return values.size() >= kDistinct;
}

/// Whether the speeds of a run differ by as much as a torque of that step must show: of one in steps, the direction.
bool SpansSpeeds(const Measurements& m, const ConstantRun& run, double step) {
  const auto velocity = m.velocity.segment(run.begin, run.end - run.begin);
  if (step > 0) return velocity.maxCoeff() > 0 && velocity.minCoeff() < 0;
  const double largest = velocity.cwiseAbs().maxCoeff();
  return velocity.maxCoeff() - velocity.minCoeff() > kOtherSpeed * largest;
}

/// Typical |torque| at each x: that of the median bin of x, times x over that of the bin where x is more, as friction grows
/// no faster than speed, and the torque of inertia as acceleration does. x: [n], 0 or more; size: [n] |torque|. Returns [n]
VectorXd TypicalOver(const VectorXd& x, const VectorXd& size) {
  std::vector<Index> order(static_cast<size_t>(x.size()));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](Index i) { return x[i]; });
  // median x and size of bins of equally many samples
  const Index bins = std::min(kBins, x.size());
  VectorXd at(bins), typical(bins);
  for (Index b = 0; b < bins; ++b) {
    const Index first = b * x.size() / bins, count = (b + 1) * x.size() / bins - first;
    VectorXd sizes(count);
    for (Index k = 0; k < count; ++k) sizes[k] = size[order[static_cast<size_t>(first + k)]];
    typical[b] = MedianInPlace(sizes);
    at[b] = std::max(x[order[static_cast<size_t>(first + count / 2)]], 1e-9 * x.maxCoeff());
  }
  return x.unaryExpr([&](double value) {
    VectorXd scaled = typical.array() * (value / at.array()).max(1.0);
    return MedianInPlace(scaled);
  });
}

}  // namespace

std::optional<std::string> ClippedTorque(const Measurements& measurements,
                                         const Selection& selection) {
  // clipping piles samples up at the end of the range
  const auto least = std::max(
      kPile, static_cast<Index>(std::ceil(kPileShare * static_cast<double>(selection.count()))));
  for (const double sign : {1.0, -1.0}) {
    const Pile pile = FindPile(measurements, selection, sign);
    if (pile.value <= 0 || pile.samples < least || pile.samples <= kAboveNext * pile.at_next) {
      continue;
    }
    // a torque of few values, or without noise, piles up by itself
    if (!TakesManyValues(measurements, selection) ||
        !MeasureTorqueNoise(measurements, selection).IsNoisy()) {
      return std::nullopt;
    }
    return fmt::format(
        "torque is clipped: {} of {} samples at constant speed are at {:.6g} {} exactly, the first "
        "at {:.6g} s, {} at the value next to it (more than {} times as many are taken as "
        "clipped); raise the limit of the drive or of the log, or leave out what reaches it",
        pile.samples, selection.count(), sign * pile.value, measurements.torque_unit,
        measurements.time[pile.first], pile.at_next, kAboveNext);
  }
  return std::nullopt;
}

std::optional<std::string> StuckTorque(const Measurements& measurements,
                                       const Selection& selection) {
  // a torque of coarse steps often repeats its last value
  const TorqueNoiseStatistics noise = MeasureTorqueNoise(measurements, selection);
  if (noise.equal > kFewEqual) return std::nullopt;
  const double highest = measurements.torque.maxCoeff(), lowest = measurements.torque.minCoeff();
  const double step = Resolution(measurements.torque);
  Index runs = 0;
  ConstantRun longest;
  for (const ConstantRun& run : noise.long_runs) {
    const double value = measurements.torque[run.begin];
    if (value != 0 && (value == highest || value == lowest)) continue;  // clipped
    // without noise only a change of speed shows that the value should have changed
    if (!noise.IsNoisy() && !SpansSpeeds(measurements, run, step)) continue;
    ++runs;
    if (run.kept > longest.kept) longest = run;
  }
  if (runs == 0) return std::nullopt;
  return fmt::format(
      "torque is stuck: {} time{}, the longest at {:.6g} {} for {} samples from {:.6g} to {:.6g} s "
      "while the joint moves (bound: {} samples; elsewhere {:.2g} % of the steps are 0); cut that "
      "out or repair the log",
      runs, runs == 1 ? "" : "s", measurements.torque[longest.begin], measurements.torque_unit,
      longest.kept, measurements.time[longest.begin], measurements.time[longest.end - 1], kLongRun,
      100 * noise.equal);
}

std::optional<std::string> DroppedTorque(const Measurements& measurements,
                                         const Selection& selection) {
  // short runs of exact zeros
  const VectorXd& torque = measurements.torque;
  Index drops = 0, first = -1;
  for (Index begin = 0, end = 0; begin < torque.size(); begin = end) {
    end = begin + 1;
    if (torque[begin] != 0) continue;
    while (end < torque.size() && torque[end] == 0) ++end;
    const Index kept = selection.keep.segment(begin, end - begin).count();
    // a run as long as those of a stuck torque is no loss of single samples
    if (kept == 0 || kept >= kLongRun) continue;
    if (drops == 0) first = begin;
    drops += kept;
  }
  if (drops < kDrops) return std::nullopt;

  // the number of other samples near 0, and of those with the smallest size
  double sum = 0, smallest = kInfinity;
  for (Index i = 0; i < torque.size(); ++i) {
    if (!selection.keep[i] || torque[i] == 0) continue;
    sum += std::abs(torque[i]);
    smallest = std::min(smallest, std::abs(torque[i]));
  }
  // a torque that is often near 0 may as well be 0
  const double near = kNear0 * sum / static_cast<double>(selection.count());
  Index others = 0;
  for (Index i = 0; i < torque.size(); ++i) {
    const double size = std::abs(torque[i]);
    others += selection.keep[i] && size > 0 && (size < near || size == smallest);
  }
  if (drops <= kRarer * others) return std::nullopt;
  return fmt::format(
      "torque drops to exactly 0 in {} moving samples, the first at {:.6g} s, and is far from 0 "
      "elsewhere (bound: {} samples): values that the log lost; leave those samples out",
      drops, measurements.time[first], kDrops);
}

SampleMask AbsurdTorque(const Measurements& m, const Selection& selection) {
  // the samples that a fit takes; a torque of 0 is that of a motor which is switched off
  const bool holds = HoldsSpeeds(m, selection);
  const double clear = ClearSpeed(m);
  std::vector<Index> taken;
  for (Index i = 0; i < m.size(); ++i) {
    const bool is_taken = holds ? selection.keep[i] : std::abs(m.velocity[i]) > clear;
    if (is_taken && m.torque[i] != 0) taken.push_back(i);
  }
  const VectorXd speed = m.velocity(taken).cwiseAbs(), size = m.torque(taken).cwiseAbs();

  // how many times the typical torque each has
  VectorXd times = VectorXd::Zero(m.size());
  times(taken) = size.cwiseQuotient(TypicalOver(speed, size)) / (holds ? 1 : kTransient);

  // far from typical by itself, or together with others
  SampleMask absurd = SampleMask::Constant(m.size(), false);
  const auto far = (times.array() > kFarOff).count();
  const bool many = static_cast<double>(far) >= kMany * static_cast<double>(taken.size());
  for (Index begin = 0, end = 0; begin < m.size(); begin = end + 1) {
    for (end = begin; end < m.size() && times[end] > kFarOff; ++end) {
      absurd[end] = many || times[end] > kAbsurd;
    }
    if (end - begin >= kRun) absurd.segment(begin, end - begin).setConstant(true);
  }
  return absurd;
}

std::string DescribeAbsurd(const Measurements& m, const SampleMask& absurd) {
  constexpr int most = 4;  // stretches named; why: more fill a screen
  std::string times;
  int stretches = 0;
  for (Index begin = 0, end = 0; begin < m.size(); begin = end) {
    end = begin + 1;
    if (!absurd[begin]) continue;
    // a stretch goes on over a few that are not absurd
    Index last = begin;
    for (; end < m.size() && end - last <= kSameStretch; ++end) last = absurd[end] ? end : last;
    if (++stretches > most) continue;
    times +=
        fmt::format("{}{:.6g} to {:.6g} s", times.empty() ? "" : ", ", m.time[begin], m.time[last]);
  }
  Index worst = 0;
  (absurd.cast<double>() * m.torque.array().abs()).maxCoeff(&worst);
  return fmt::format(
      "torque is far out of range in {} of {} samples, in {} stretch{} ({}{}), the worst {:.4g} {} "
      "at {:.6g} s: more than {} times what is typical of its speed",
      absurd.count(), m.size(), stretches, stretches == 1 ? "" : "es", times,
      stretches > most ? ", ..." : "", m.torque[worst], m.torque_unit, m.time[worst], kFarOff);
}

}  // namespace warmjoint
