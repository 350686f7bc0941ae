#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "identification/preparation/log_faults.h"
#include "identification/preparation/stretches.h"
#include "models/foundation/robust_noise.h"
#include "models/recording/units.h"

namespace warmjoint::inline identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kTolerance = 0.02;  // of the factor; why: viscous moves by as much, --relevance
constexpr double kOneDirection =
    0.1;  // why: an offset of the column moves them apart, and friction by less than that
constexpr double kCertain = 4;        // standard errors of the median; why: 1 in 16 000 by chance
constexpr std::size_t kFewest = 8;    // stretches; why: a median of fewer has no known error
constexpr double kSameFactor = 0.03;  // between a factor and that of a unit
constexpr double kNormal = 0.6745;    // why: median |z| of a standard normal

/// Velocity over change of position along stretches.
struct Factor {
  double times = 1;                  // where the velocity does not change
  double error = 0;                  // standard error
  double allowed = 0;                // by which a right column may be off
  double told = 0, by_position = 0;  // median velocities, rad/s or m/s
  std::size_t count = 0;             // stretches

  bool IsOff(double tolerance) const {
    const double off = std::abs(times - 1);
    return count >= kFewest && off > tolerance + allowed && off > kCertain * error;
  }
};

double MedianOf(const Eigen::ArrayXd& values) {
  VectorXd copy = values;
  return copy.size() == 0 ? 0 : MedianInPlace(copy);
}

double Integral(const Measurements& m, const Stretch& one) {
  double integral = 0;
  for (Index i = one.first + 1; i <= one.last; ++i) {
    integral += 0.5 * (m.velocity[i] + m.velocity[i - 1]) * (m.time[i] - m.time[i - 1]);
  }
  return integral;
}

/// A column that lags by c has ratio = times + c bend, bend = change of velocity / change of
/// position: `times` from the half of the stretches with the least bend, c from the others. A filter
/// with that c passes (c bend)^2 less, a delay half of it, and trapezoids of a step h are
/// (h bend)^2 / 12 off; a column in coarse steps may err by one, as far as the ratios scatter by it.
Factor FactorOf(const Measurements& m, const std::vector<Stretch>& stretches) {
  const auto n = static_cast<Index>(stretches.size());
  Eigen::ArrayXd ratio(n), bend(n), told(n), by_position(n);
  for (Index k = 0; k < n; ++k) {
    const Stretch& one = stretches[static_cast<size_t>(k)];
    const double integral = Integral(m, one);
    ratio[k] = integral / one.way;
    bend[k] = (m.velocity[one.last] - m.velocity[one.first]) / one.way;
    told[k] = integral / one.duration;
    by_position[k] = one.way / one.duration;
  }

  // the factor where the velocity changes least, and its scatter there
  const double typical = MedianOf(bend.abs());
  std::vector<Index> straight, bent;
  for (Index k = 0; k < n; ++k) {
    if (std::abs(bend[k]) <= typical) straight.push_back(k);
    if (std::abs(bend[k]) >= typical && bend[k] != 0) bent.push_back(k);
  }
  Factor factor{MedianOf(ratio(straight)), 0, 0, 0, MedianOf(by_position), stretches.size()};
  const double scatter = MedianOf((ratio(straight) - factor.times).abs()) / kNormal;
  factor.told = factor.by_position + MedianOf(told - by_position);
  factor.error = std::sqrt(std::numbers::pi / 2 / static_cast<double>(straight.size())) * scatter;

  // what a lag, long steps and a coarse column take off a right one
  const double lag = MedianOf((ratio(bent) - factor.times) / bend(bent)), step = MedianStep(m.time);
  const double coarse = MedianOf(Resolution(m.velocity) / by_position.abs());
  factor.allowed =
      (lag * lag + step * step / 12) * typical * typical + std::min(coarse, kCertain * scatter);
  return factor;
}

/// The unit that explains a velocity of `times` the change of position over time, as a question.
std::string Suspect(const Measurements& m, double times) {
  const auto is_near = [&](double factor) {
    return std::abs(std::abs(times) / factor - 1) < kSameFactor;
  };
  if (is_near(1)) return "has it the wrong sign (--scale velocity=-1)";
  const bool rotary = m.joint == JointKind::rotary;
  // velocity, position or time may be in another unit of the table
  for (const Unit& unit : Units()) {
    if (unit.factor == 1) continue;
    const std::string_view name = unit.name;
    if (unit.base == (rotary ? "rad/s" : "m/s") && is_near(1 / unit.factor)) {
      return fmt::format("is it in {} (--unit velocity={})", name, name);
    }
    if (unit.base == (rotary ? "rad" : "m") && is_near(unit.factor)) {
      return fmt::format("is the position in {} (--unit position={})", name, name);
    }
    if (unit.base == "s" && is_near(1 / unit.factor)) {
      return fmt::format("is time in {} (--unit time={})", name, name);
    }
  }
  const std::string scale = fmt::format("--scale velocity={:.4g}", 1 / times);
  if (m.gear != 1 && is_near(std::abs(m.gear)))
    return fmt::format("is it that of the motor ({})", scale);
  return fmt::format(
      "are the units right (--unit velocity=..., position=..., time=...), or is the velocity "
      "scaled ({}) or the clock "
      "(--scale time={:.4g})",
      scale, times);
}

}  // namespace

std::optional<std::string> VelocityAgainstPosition(const Measurements& measurements,
                                                   const Selection&) {
  const std::vector<Stretch> all = FindStretches(measurements);
  if (all.size() < kFewest) return std::nullopt;
  std::vector<Stretch> forwards, backwards;
  for (const Stretch& one : all) (one.way > 0 ? forwards : backwards).push_back(one);
  // one direction may be spoilt by itself
  const Factor ahead = FactorOf(measurements, forwards), back = FactorOf(measurements, backwards);
  const Factor& off = ahead.IsOff(kOneDirection) ? ahead : back;
  const bool is_mirrored = std::abs(ahead.times + back.times) < kOneDirection * std::abs(off.times);
  if (std::min(ahead.count, back.count) >= kFewest && off.IsOff(kOneDirection) &&
      (is_mirrored || !ahead.IsOff(kOneDirection) || !back.IsOff(kOneDirection))) {
    const std::string_view unit = kVelocityUnit.For(measurements.joint);
    return fmt::format(
        "velocity is right in one direction alone: in the other, {:.0f} % of what moves, it is "
        "{:.4g} {} where the positions change by {:.4g} {} (medians of {} stretches), so that it "
        "{}; "
        "leave the velocity out (--map velocity=), and the positions tell it",
        100 * static_cast<double>(off.count) / static_cast<double>(all.size()), off.told, unit,
        off.by_position, unit, off.count,
        is_mirrored ? "lost its sign" : "holds words read as unsigned, or its zero is off");
  }

  const Factor both = FactorOf(measurements, all);
  if (!both.IsOff(kTolerance)) return std::nullopt;
  return fmt::format(
      "velocity is {:.4g} times the change of position over time (median of {} stretches, at least "
      "{:.0f} % apart), so that one of the two is off: {}? Else leave the velocity out "
      "(--map velocity=), and the positions tell it",
      both.times, both.count, 100 * kTolerance, Suspect(measurements, both.times));
}

}  // namespace warmjoint::inline identification
