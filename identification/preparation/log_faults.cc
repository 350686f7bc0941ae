#include "identification/preparation/log_faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

using Eigen::Index;

constexpr std::size_t kFewest = 2;   // jumps
constexpr double kOfTheRange = 0.5;  // that a jump spans
constexpr double kAlike = 0.01;      // between jumps
constexpr double kBeyond = 4;        // times what the speed allows
constexpr double kMirrored =
    0.75;  // of the jumps; why: a joint turns round at few of the places where a range starts again

}  // namespace

std::vector<LogFault> FindFaults(const Measurements& measurements, const Selection& selection,
                                 MotionSource source) {
  const SampleMask absurd = AbsurdTorque(measurements, selection);
  Selection left = selection;
  left.keep = left.keep && !absurd;
  std::vector<LogFault> faults;
  for (const auto find : {&WrappedPosition, &VelocityAgainstPosition, &TorqueDirections,
                          &ClippedTorque, &StuckTorque, &DroppedTorque, &Backlash}) {
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
  double mirrored = 0,
         upper = 0;  // jumps after which the positions run back, and where they begin or end
  // steps within a recording that cover a large part of the range at once
  for (Index i = 1; i + 1 < m.size(); ++i) {
    const double h = m.time[i] - m.time[i - 1];
    const double jump = m.position[i] - m.position[i - 1];
    if (h > longest || !(std::abs(jump) > kOfTheRange * range)) continue;

    // the distance of the next step, which is about what the step of the jump would cover without a jump
    const double beside = std::abs(m.position[i + 1] - m.position[i]);
    if (std::abs(jump) <= kBeyond * beside) continue;
    jumps.push_back(std::abs(jump) + beside);
    if (i < 2) continue;
    const double before = m.position[i - 1] - m.position[i - 2];
    mirrored += before * (m.position[i + 1] - m.position[i]) < 0;
    upper += std::max(m.position[i], m.position[i - 1]);
  }
  if (jumps.size() < kFewest) return std::nullopt;
  // a range that starts again jumps by the same distance each time
  const auto [least, most] = std::ranges::minmax(jumps);
  if (most - least > kAlike * most) return std::nullopt;

  // turns are undone while reading
  constexpr double turn = 2 * std::numbers::pi;  // rad
  if (m.joint == JointKind::rotary && std::abs(most - turn) <= kAlike * turn) return std::nullopt;
  const std::string_view unit = kPositionUnit.For(m.joint);
  const auto count = static_cast<double>(jumps.size());
  if (mirrored > kMirrored * count) {
    return fmt::format(
        "position jumps to {:.6g} {} and back {} times, and runs backwards there: its highest bit "
        "is a sign; write positions p with that bit, of value B, as B - p in the file",
        upper / count, unit, jumps.size());
  }
  return fmt::format(
      "position jumps by {:.6g} {} {} times: it starts again after a range of its own; give that "
      "range in the unit of the file (--wrap {:.4g})",
      most, unit, jumps.size(), most);
}

}  // namespace warmjoint
