#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "identification/preparation/log_faults.h"
#include "identification/preparation/torque_noise_statistics.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint::inline identification {
namespace {

using Eigen::Index;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

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

// AbsurdTorque
constexpr double kAbsurd = 50;  // times the quantile
constexpr double kMost = 0.99;

/// Kept samples whose torque, times `sign`, lies farthest on that side.
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
  const Eigen::VectorXd& torque = measurements.torque;
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

  // what else is near 0, and how many have the smallest size
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

std::optional<std::string> AbsurdTorque(const Measurements& measurements,
                                        const Selection& selection) {
  const Eigen::VectorXd& torque = measurements.torque;
  // mean and largest size of what is kept
  double sum = 0, largest = 0;
  for (Index i = 0; i < torque.size(); ++i) {
    const double size = selection.keep[i] ? std::abs(torque[i]) : 0;
    sum += size;
    largest = std::max(largest, size);
  }

  // mean <= quantile + 0.01 largest: below that many means nothing exceeds kAbsurd quantiles
  const auto count = static_cast<double>(selection.count());
  if (largest * (1 / kAbsurd + 1 - kMost) * count <= sum) return std::nullopt;
  // the quantile that almost all samples stay below, and those far beyond it
  Eigen::VectorXd sizes(selection.count());
  for (Index i = 0, k = 0; i < torque.size(); ++i) {
    if (selection.keep[i]) sizes[k++] = std::abs(torque[i]);
  }
  const double quantile = QuantileInPlace(sizes, kMost);
  if (quantile == 0 || largest <= kAbsurd * quantile) return std::nullopt;
  // how many are far beyond it, and the worst
  Index absurd = 0, worst = -1;
  for (Index i = 0; i < torque.size(); ++i) {
    if (!selection.keep[i] || std::abs(torque[i]) <= kAbsurd * quantile) continue;
    ++absurd;
    if (std::abs(torque[i]) == largest) worst = i;
  }
  return fmt::format(
      "torque is far out of range in {} sample{}, the worst {:.4g} {} at {:.6g} s: more than {} "
      "times the 99 % quantile of its size, {:.4g} {}; leave {} out",
      absurd, absurd == 1 ? "" : "s", torque[worst], measurements.torque_unit,
      measurements.time[worst], kAbsurd, quantile, measurements.torque_unit,
      absurd == 1 ? "it" : "them");
}

}  // namespace warmjoint::inline identification
