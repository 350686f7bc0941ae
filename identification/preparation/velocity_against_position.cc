#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "identification/preparation/log_faults.h"
#include "identification/preparation/stretches.h"
#include "models/foundation/robust_noise.h"
#include "models/recording/units.h"

namespace warmjoint {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::VectorXd;

constexpr double kTolerance = 0.02;  // of the factor; why: viscous changes by as much, --relevance
constexpr double kOneDirection =
    0.1;  // why: an offset of the column makes the directions differ, and changes the friction by less than that
constexpr double kCertain = 4;      // standard errors of the median; why: 1 in 16 000 by chance
constexpr std::size_t kFewest = 8;  // stretches; why: a median of fewer has no known error
constexpr double kOther = 0.5;  // of a factor; why: stale positions and lags at turns stay within
constexpr double kMostChange =
    3;  // why: fast stretches determine a factor best, but a few that are wrong must not decide
constexpr std::size_t kRow = 3;       // stretches; why: a turn spoils one or two
constexpr double kSameFactor = 0.03;  // between a ratio and the factor of a unit
constexpr double kMostRounded =
    0.1;  // of a factor; why: coarser columns are in no unit that could be named
constexpr double kNormal = 0.6745;  // why: median |z| of a standard normal
constexpr double kWhole = 0.05;     // of a step; why: as Resolution allows
constexpr double kFewSteps = 2;     // why: the error of a step is half or more of what shows fewer
constexpr double kRoundsDown = 1,
                 kRoundsUp = 0.5;  // steps; why: the most that cutting off and rounding change

/// Velocity over change of position along stretches.
struct Factor {
  double times = 1;                       // where the velocity does not change
  double error = 0;                       // standard error
  double allowed = 0;                     // error that a correct column may have
  double rounded = 0;                     // share of itself that rounding to steps may change
  double by_column = 0, by_position = 0;  // median velocities, rad/s or m/s
  std::vector<Stretch> others;            // three or more in a row with another factor

  bool IsOff(double tolerance) const {
    // of a factor far from 1 the inverse is better known
    const double off = std::abs(times - 1);
    return off > tolerance + allowed && std::max(off, std::abs(times) * off) > kCertain * error;
  }
};

/// The value below which half of the change of position lies; a stretch counts no more than kMostChange times the median one.
double MedianByChange(const ArrayXd& values, const ArrayXd& change) {
  const ArrayXd weight = change.min(kMostChange * MedianOf(change));
  std::vector<Index> order(static_cast<size_t>(values.size()));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](Index k) { return values[k]; });
  double until = 0;
  for (const Index k : order) {
    until += weight[k];
    if (until >= weight.sum() / 2) return values[k];
  }
  return 0;
}

double Integral(const Measurements& m, const Stretch& one) {
  double integral = 0;
  for (Index i = one.first + 1; i <= one.last; ++i) {
    integral += 0.5 * (m.velocity[i] + m.velocity[i - 1]) * (m.time[i] - m.time[i - 1]);
  }
  return integral;
}

/// Step of a column of whole steps, in its own unit, by all of its values; 0 of any other: exact speeds may differ by multiples of one
/// that they are none of.
double WholeStep(VectorXd velocity) {
  std::ranges::sort(velocity);
  const double step = Resolution(velocity);
  if (step == 0) return 0;
  const ArrayXd counts = velocity.array() / step;
  return ((counts - counts.round()).abs() <= kWhole).all() ? step : 0;
}

/// Whether a right column may say this of a stretch because it comes in steps: it shows fewer than kFewSteps, and the position
/// changes by no more than one step less or more. Both are counted in steps of the column.
bool IsHiddenByStep(const Measurements& m, const Stretch& one, double step) {
  const double one_step = std::copysign(step * one.duration, one.change);
  const double shown = Integral(m, one) / one_step, moved = one.change / one_step;
  return shown < kFewSteps && shown > moved - kRoundsDown && shown < moved + kRoundsUp;
}

/// Share of the rows that are 0 among those between others, over stretches in which the joint moves.
double ShareOfZeros(const Measurements& m, const std::vector<Stretch>& stretches) {
  Index zeros = 0, rows = 0;
  for (const Stretch& one : stretches) {
    Index first = one.first, last = one.last;
    while (first < last && m.velocity[first] == 0) ++first;
    while (last > first && m.velocity[last] == 0) --last;
    zeros += (m.velocity.segment(first, last - first).array() == 0).count();
    rows += last - first;
  }
  return rows > 0 ? static_cast<double>(zeros) / static_cast<double>(rows) : 0;
}

/// The error of a ratio by a jump of speed within a step, half of the largest change of velocity times the step over
/// the change, and by time stamps that jitter, the spread of the steps over the duration.
double Unsure(const Measurements& m, const Stretch& one) {
  const Index n = one.last - one.first;
  const VectorXd steps = m.time.segment(one.first + 1, n) - m.time.segment(one.first, n);
  const VectorXd changes = m.velocity.segment(one.first + 1, n) - m.velocity.segment(one.first, n);
  const double jump = 0.5 * changes.cwiseAbs().maxCoeff() * one.duration / static_cast<double>(n);
  return jump / std::abs(one.change) + (steps.maxCoeff() - steps.minCoeff()) / one.duration;
}

/// Stretches in a row, kRow or more, where `is_other` holds.
std::vector<Stretch> InARow(const std::vector<Stretch>& stretches, const SampleMask& is_other) {
  std::vector<Stretch> rows;
  for (size_t begin = 0, end = 0; begin < stretches.size(); begin = end + 1) {
    for (end = begin; end < stretches.size() && is_other[static_cast<Index>(end)];) ++end;
    if (end < begin + kRow) continue;
    const auto first = stretches.begin();
    rows.insert(rows.end(), first + static_cast<Index>(begin), first + static_cast<Index>(end));
  }
  return rows;
}

/// By how much of its change a stretch may begin and end with positions that are held for several samples.
double Staleness(const Measurements& m, const std::vector<Stretch>& stretches) {
  double steps = 0, moved = 0;
  for (const Stretch& one : stretches) {
    for (Index i = one.first; i < one.last; ++i) moved += m.position[i + 1] != m.position[i];
    steps += static_cast<double>(one.last - one.first);
  }
  const double held = steps / moved - 1;  // samples
  return held * static_cast<double>(stretches.size()) / steps;
}

/// A column that lags by c has ratio = times + c bend, bend = change of velocity / change of
/// position: `times` from the half of the stretches with the least bend, c from the others. A filter
/// with that c passes (c bend)^2 less, a delay half of it, and trapezoids of a step h have an error of
/// (h bend)^2 / 12. A column in coarse steps may have an error of one step, as far as the
/// ratios scatter by it. whole_step: WholeStep
Factor FactorOf(const Measurements& m, const std::vector<Stretch>& stretches, double whole_step) {
  const auto n = static_cast<Index>(stretches.size());
  ArrayXd integral(n), change(n), bend(n), duration(n), unsure(n);
  for (Index k = 0; k < n; ++k) {
    const Stretch& one = stretches[static_cast<size_t>(k)];
    integral[k] = Integral(m, one);
    change[k] = one.change;
    duration[k] = one.duration;
    unsure[k] = Unsure(m, one);
    bend[k] = (m.velocity[one.last] - m.velocity[one.first]) / one.change;
  }

  // the factor where the velocity changes least, and its scatter there
  const ArrayXd ratio = integral / change;
  const double typical = MedianOf(bend.abs());
  const SampleMask least = bend.abs() <= typical;
  const ArrayXd straight = Chosen(ratio, least);
  Factor factor;
  factor.times = MedianByChange(straight, Chosen(change.abs(), least));
  const double scatter = MedianOf((straight - factor.times).abs()) / kNormal;
  factor.error = std::sqrt(std::numbers::pi / 2 / static_cast<double>(straight.size())) * scatter;
  factor.by_position = MedianOf(change / duration);
  factor.by_column = factor.by_position + MedianOf((integral - change) / duration);
  const ArrayXd off = (integral - factor.times * change).abs(),
                own = std::abs(factor.times) * change.abs();
  factor.others = InARow(stretches, off > kOther * own && off > MedianOf(own));

  // the error of a correct column by a lag, long steps and coarse values
  const SampleMask bent = bend.abs() >= typical && bend != 0;
  const double lag = MedianOf(Chosen((ratio - factor.times) / bend, bent));
  // how much a right column bends, where this one is in a larger unit
  const double bends = typical / std::max(1.0, std::abs(factor.times));
  const double step = MedianStep(m.time);
  const double coarse = MedianOf(Resolution(m.velocity) * duration / change.abs());
  factor.rounded = std::min(kMostRounded, MedianOf(0.5 * whole_step * duration / integral.abs()));
  factor.allowed = (lag * lag + step * step / 12) * typical * bends +
                   std::min(coarse, kCertain * scatter) + MedianOf(unsure) +
                   Staleness(m, stretches);
  return factor;
}

/// The units that explain a velocity of so many times the change of position over time, as questions. tolerance: of that factor
std::vector<std::string> UnitsNear(const Measurements& m, double times, double tolerance) {
  const auto is_near = [&](double factor) {
    return std::abs(std::abs(times) / factor - 1) < tolerance;
  };
  const bool rotary = m.joint == JointKind::rotary;
  std::vector<std::string> questions;
  // velocity, position or time may be in another unit of the table
  for (const Unit& unit : Units()) {
    if (unit.factor == 1) continue;
    const std::string_view name = unit.name;
    if (unit.base == (rotary ? "rad/s" : "m/s") && is_near(1 / unit.factor)) {
      questions.push_back(fmt::format("is it in {} (--unit velocity={})", name, name));
    }
    if (unit.base == (rotary ? "rad" : "m") && is_near(unit.factor)) {
      questions.push_back(fmt::format("is the position in {} (--unit position={})", name, name));
    }
    if (unit.base == "s" && is_near(1 / unit.factor)) {
      questions.push_back(fmt::format("is time in {} (--unit time={})", name, name));
    }
  }
  if (m.gear != 1 && is_near(std::abs(m.gear))) {
    questions.push_back(
        fmt::format("is it that of the motor (--scale velocity={:.4g})", 1 / m.gear));
  }
  return questions;
}

/// What may explain a velocity of so many times the change of position over time, as a question. times: other than 1; rounded: share
/// of it that rounding may change
std::string Suspect(const Measurements& m, double times, double rounded) {
  if (std::abs(times + 1) < kSameFactor) return "has it the wrong sign (--scale velocity=-1)";
  std::vector<std::string> questions = UnitsNear(m, times, kSameFactor);
  // a column of few steps may be in a unit that its factor misses, or in none
  if (questions.empty()) {
    questions = UnitsNear(m, times, kSameFactor + rounded);
    questions.push_back(
        fmt::format("is it that of the motor, or scaled (--scale velocity={:.4g}), are other units "
                    "wrong (--unit position=..., time=...), or is the clock (--scale time={:.4g})",
                    1 / times, times));
  }
  return fmt::format("{}", fmt::join(questions, ", or "));
}

/// The sentence about a velocity that is off throughout. remedy: where no factor explains it
std::string ExplainFactor(const Measurements& m, const std::vector<Stretch>& stretches,
                          const Factor& factor, std::string_view remedy) {
  if (factor.times == 0) {
    return fmt::format("velocity is 0 where the positions change (along {} stretches): {}",
                       stretches.size(), remedy);
  }
  // rows that hold no velocity, and what the others say
  const double zeros = ShareOfZeros(m, stretches), others = factor.times / (1 - zeros);
  if (zeros > kTolerance) {
    const bool is_right = std::abs(others - 1) <= kTolerance + factor.allowed;
    return fmt::format(
        "velocity is 0 in {:.0f} % of the rows at which the positions change, and {:.4g} times "
        "their change over time in the others{}; {}",
        100 * zeros, others,
        is_right ? "" : fmt::format(": {}?", Suspect(m, others, factor.rounded)), remedy);
  }
  return fmt::format(
      "velocity is {:.4g} times the change of position over time (along {} stretches, at least "
      "{:.0f} % apart), so that one of the two is off: {}? Else {}",
      factor.times, stretches.size(), 100 * kTolerance, Suspect(m, factor.times, factor.rounded),
      remedy);
}

}  // namespace

std::optional<std::string> VelocityAgainstPosition(const Measurements& measurements,
                                                   const Selection&) {
  // a column in coarse steps does not show speeds of a step or two
  std::vector<Stretch> all = FindStretches(measurements);
  const double step = WholeStep(measurements.velocity);
  if (step > 0) {
    std::erase_if(all, [&](const Stretch& one) { return IsHiddenByStep(measurements, one, step); });
  }
  if (all.size() < kFewest) return std::nullopt;
  std::vector<Stretch> forwards, backwards;
  for (const Stretch& one : all) (one.change > 0 ? forwards : backwards).push_back(one);
  const std::string_view unit = kVelocityUnit.For(measurements.joint);
  constexpr const char* remedy =
      "leave the velocity out (--map velocity=), and it is taken from the positions";

  // one direction may be wrong by itself
  if (std::min(forwards.size(), backwards.size()) >= kFewest) {
    const Factor ahead = FactorOf(measurements, forwards, step),
                 back = FactorOf(measurements, backwards, step);
    const bool is_ahead = ahead.IsOff(kOneDirection);
    const Factor& off = is_ahead ? ahead : back;
    const bool lost = std::abs(ahead.times + back.times) < kOneDirection * std::abs(off.times);
    if (off.IsOff(kOneDirection) && (lost || is_ahead != back.IsOff(kOneDirection))) {
      const auto count = (is_ahead ? forwards : backwards).size();
      return fmt::format(
          "velocity is right in one direction alone: in the other, {:.0f} % of what moves, it is "
          "{:.4g} {} where the positions change by {:.4g} {} (medians of {} stretches), so that it "
          "{}; {}",
          100 * static_cast<double>(count) / static_cast<double>(all.size()), off.by_column, unit,
          off.by_position, unit, count,
          lost ? "lost its sign" : "holds words read as unsigned, or its zero is off", remedy);
    }
  }

  // both by the same factor, or a part of the log
  const Factor both = FactorOf(measurements, all, step);
  if (both.IsOff(kTolerance)) return ExplainFactor(measurements, all, both, remedy);
  if (both.others.empty()) return std::nullopt;
  const Stretch& typical = both.others[both.others.size() / 2];
  return fmt::format(
      "velocity and position contradict each other in {:.2g} % of what moves, between {:.6g} and "
      "{:.6g} s: velocity is {:.4g} times the change of position there, elsewhere {:.4g} times; "
      "leave that part of the log out",
      100 * static_cast<double>(both.others.size()) / static_cast<double>(all.size()),
      measurements.time[both.others.front().first], measurements.time[both.others.back().last],
      Integral(measurements, typical) / typical.change, both.times);
}

}  // namespace warmjoint
