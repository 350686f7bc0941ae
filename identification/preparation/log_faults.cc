#include "identification/preparation/log_faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

using Eigen::Index;

constexpr std::size_t kFewest = 2;   // jumps
constexpr double kOfTheRange = 0.5;  // that a jump spans
constexpr double kAlike = 0.01;      // between jumps
constexpr double kBeyond = 4;        // times what the speed allows

}  // namespace

std::vector<LogFault> FindFaults(const Measurements& measurements, const Selection& selection,
                                 MotionSource source) {
  const SampleMask absurd = AbsurdTorque(measurements, selection);
  Selection left = selection;
  left.keep = left.keep && !absurd;
  std::vector<LogFault> faults;
  for (const auto find : {&WrappedPosition, &VelocityAgainstPosition, &TorqueDirections,
                          &ClippedTorque, &StuckTorque, &DroppedTorque}) {
    if (source == MotionSource::positions && find == &VelocityAgainstPosition) continue;
    if (auto fault = find(measurements, left)) faults.push_back({*std::move(fault)});
  }
  if (!absurd.any()) return faults;
  faults.push_back({DescribeAbsurd(measurements, absurd) +
                        "; cut that out, or take a loss that leaves it out (--set loss=huber, of "
                        "energy-ml and nominal-ls)",
                    true});
  return faults;
}

std::optional<std::string> WrappedPosition(const Measurements& measurements, const Selection&) {
  const Measurements& m = measurements;
  const double range = m.position.maxCoeff() - m.position.minCoeff();
  const double longest = LongestStep(m.time);
  std::vector<double> jumps;
  // steps within a recording that cover a large part of the range at once
  for (Index i = 1; i + 1 < m.size(); ++i) {
    const double h = m.time[i] - m.time[i - 1];
    const double jump = m.position[i] - m.position[i - 1];
    if (h > longest || !(std::abs(jump) > kOfTheRange * range)) continue;

    // the distance of the next step at the speed beside the jump, where there is no jump
    const double beside = std::abs(m.position[i + 1] - m.position[i]);
    if (std::abs(jump) <= kBeyond * beside) continue;
    jumps.push_back(std::abs(jump) + beside);
  }
  if (jumps.size() < kFewest) return std::nullopt;
  // a range that starts again jumps by the same distance each time
  const auto [least, most] = std::ranges::minmax(jumps);
  if (most - least > kAlike * most) return std::nullopt;

  // turns are undone while reading
  constexpr double turn = 2 * std::numbers::pi;  // rad
  if (m.joint == JointKind::rotary && std::abs(most - turn) <= kAlike * turn) return std::nullopt;
  return fmt::format(
      "position jumps by {:.6g} {} {} times: it starts again after a range of its own; give that "
      "range in the unit of the file (--wrap {:.4g})",
      most, m.joint == JointKind::rotary ? "rad" : "m", jumps.size(), most);
}

}  // namespace warmjoint
