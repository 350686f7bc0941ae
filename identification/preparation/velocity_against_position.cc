#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "identification/preparation/log_faults.h"
#include "models/foundation/robust_noise.h"
#include "models/recording/units.h"

namespace warmjoint::inline identification {
namespace {

using Eigen::Index;

constexpr double kTolerance = 0.02;   // of the ratio; why: viscous moves by as much, --relevance
constexpr double kCertain = 4;        // standard errors of the median
constexpr double kStraight = 0.003;   // of the way of a segment, rms
constexpr std::size_t kFewest = 3;    // segments
constexpr double kShare = 1.0 / 3;    // of the segments that can be judged
constexpr double kSameFactor = 0.03;  // between a ratio and the factor of a unit

/// Whether a recording starts within the segment.
bool HoldsAStart(const Measurements& m, const Segment& segment) {
  return std::ranges::any_of(
      m.starts, [&](Index start) { return start > segment.begin && start < segment.end; });
}

/// dp / integral(v dt) of a segment; nothing where the positions do not lie on a straight line.
std::optional<double> RatioOf(const Measurements& m, const Segment& segment) {
  const Index first = segment.begin, last = segment.end - 1;
  const double duration = m.time[last] - m.time[first];
  const double way = m.position[last] - m.position[first];
  // the way by the velocities, and how far the positions stray from a straight line
  double integral = 0, strays = 0;
  for (Index i = first + 1; i <= last; ++i) {
    integral += 0.5 * (m.velocity[i] + m.velocity[i - 1]) * (m.time[i] - m.time[i - 1]);
    const double line = m.position[first] + way * (m.time[i] - m.time[first]) / duration;
    strays += (m.position[i] - line) * (m.position[i] - line);
  }
  const double rms = std::sqrt(strays / static_cast<double>(last - first));
  if (!(rms < kStraight * std::abs(way)) || integral == 0) return std::nullopt;
  return way / integral;
}

/// Whether a sensor that starts its turn again may hide turns between two samples.
bool MayHideTurns(const Measurements& m, const Segment& segment, double step, double travel) {
  constexpr double turn = 2 * std::numbers::pi, slack = 1e-3 * turn;  // rad
  return m.joint == JointKind::rotary && travel <= turn + slack &&
         std::abs(segment.velocity) * step > turn / 2;
}

Eigen::VectorXd Ratios(const Measurements& m, const Selection& selection) {
  std::vector<double> ratios;
  double judged = 0;  // segments, straight or not
  if (selection.segments.size() < kFewest) return {};
  const double travel = m.position.maxCoeff() - m.position.minCoeff();
  for (const Segment& segment : selection.segments) {
    // a start of another recording, or turns between two samples, make no fair comparison
    if (segment.end - segment.begin < 2 || HoldsAStart(m, segment)) continue;
    const double step = (m.time[segment.end - 1] - m.time[segment.begin]) /
                        static_cast<double>(segment.end - 1 - segment.begin);
    if (MayHideTurns(m, segment, step, travel)) continue;
    ++judged;
    if (const auto ratio = RatioOf(m, segment)) ratios.push_back(*ratio);
  }

  // a few segments whose positions happen to be straight tell nothing of the others
  if (static_cast<double>(ratios.size()) < kShare * judged) return {};
  return Eigen::Map<const Eigen::VectorXd>(ratios.data(), static_cast<Index>(ratios.size()));
}

/// The unit that explains a velocity of `times` the change of position over time, as a question.
std::string Suspect(const Measurements& m, double times) {
  const auto is_near = [&](double factor) {
    return std::abs(std::abs(times) / factor - 1) < kSameFactor;
  };
  if (is_near(1)) return "has it the wrong sign";
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
  if (m.gear != 1 && is_near(std::abs(m.gear))) return "is it that of the motor";
  return "are the units right (--unit velocity=..., position=..., time=...)";
}

}  // namespace

std::optional<std::string> VelocityAgainstPosition(const Measurements& measurements,
                                                   const Selection& selection) {
  Eigen::VectorXd ratios = Ratios(measurements, selection);
  if (ratios.size() < static_cast<Index>(kFewest)) return std::nullopt;
  const double ratio = MedianInPlace(ratios);
  if (std::abs(ratio - 1) <= kTolerance) return std::nullopt;

  // of a median: sqrt(pi/2) of that of a mean; median |z| = 0.6745
  const auto n = static_cast<double>(ratios.size());
  Eigen::VectorXd strays = (ratios.array() - ratio).abs();
  const double error = std::sqrt(std::numbers::pi / 2 / n) * MedianInPlace(strays) / 0.6745;
  if (std::abs(ratio - 1) <= kCertain * error) return std::nullopt;
  const double times = 1 / ratio;
  return fmt::format(
      "velocity is {:.4g} times the change of position over time (median of {} segments, at least "
      "{:.0f} % apart), so that one of the two is off: {}? Else leave the velocity out "
      "(--map velocity=), and the positions tell it",
      times, ratios.size(), 100 * kTolerance, Suspect(measurements, times));
}

}  // namespace warmjoint::inline identification
