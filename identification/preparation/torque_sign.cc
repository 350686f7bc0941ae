#include <fmt/format.h>

#include "identification/preparation/log_faults.h"

namespace warmjoint::inline identification {
namespace {

constexpr int kFewest = 5;  // segments
// why these: friction never pushes; with two thirds of either no clean log is refused
constexpr double kOfSegments = 0.9;     // that are against the motion
constexpr double kOfItsSamples = 0.95;  // of a segment

}  // namespace

std::optional<std::string> TorqueSign(const Measurements& measurements,
                                      const Selection& selection) {
  int segments = 0, against = 0;
  double samples = 0, negative = 0;
  for (const Segment& segment : selection.segments) {
    // by the way: a velocity of the wrong sign is another fault
    const double way =
        measurements.position[segment.end - 1] - measurements.position[segment.begin];
    // samples of the segment whose torque points against its way
    double kept = 0, below = 0;
    for (Eigen::Index i = segment.begin; i < segment.end; ++i) {
      if (!selection.keep[i]) continue;
      ++kept;
      below += measurements.torque[i] * way < 0;
    }
    if (kept == 0) continue;
    // a segment counts as a whole, by the most of its samples
    ++segments;
    against += below > kOfItsSamples * kept;
    samples += kept;
    negative += below;
  }
  if (segments < kFewest || against < kOfSegments * segments) return std::nullopt;
  return fmt::format(
      "torque times velocity is negative in {:.0f} % of the samples at constant speed, while "
      "friction resists motion: the torque column has the opposite sign (--scale torque=-1 turns "
      "it)",
      100 * negative / samples);
}

}  // namespace warmjoint::inline identification
