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
constexpr double kUsual = 0.95;  // of the steps; why: spoilt samples are fewer, motion is more
constexpr double kBack =
    0.25;  // of the jump; why: the joint moves on meanwhile, by less than kBeyond allows
constexpr Index kLongestJump =
    10;  // samples; why: a message or two; what stays away is another place

/// The size that so many of the values do not exceed. values: at least one
double QuantileOf(Eigen::VectorXd values, double share) {
  const auto at =
      values.begin() + static_cast<Index>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Where the positions are back after a jump to sample i: the first sample that is; 0 where they do not come back. usual: step
Index BackAfter(const Eigen::VectorXd& position, Index i, double usual) {
  const double out = position[i] - position[i - 1];
  const auto calm = [&](Index k) {
    return k < 1 || k >= position.size() ||
           kBeyond * std::abs(position[k] - position[k - 1]) < std::abs(out);
  };
  if (!(std::abs(out) > kBeyond * usual) || !calm(i - 1)) return 0;
  for (Index j = i + 1; j < std::min(i + 1 + kLongestJump, position.size()); ++j) {
    const bool back = out * (position[j] - position[j - 1]) < 0 &&
                      std::abs(position[j] - position[i - 1]) < kBack * std::abs(out);
    if (back) return calm(j + 1) ? j : 0;
  }
  return 0;
}

}  // namespace

std::vector<LogFault> FindFaults(const Measurements& measurements, const Selection& selection,
                                 MotionSource source) {
  const SampleMask absurd = AbsurdTorque(measurements, selection);
  Selection left = selection;
  left.keep = left.keep && !absurd;
  std::vector<LogFault> faults;
  for (const auto find :
       {&JumpsThatReturn, &WrappedPosition, &VelocityAgainstPosition, &TorqueDirections,
        &ClippedTorque, &StuckTorque, &DroppedTorque, &Backlash}) {
    if (source == MotionSource::positions && find == &VelocityAgainstPosition) continue;
    // positions that come back do not start again
    if (find == &WrappedPosition && !faults.empty()) continue;
    if (auto fault = find(measurements, left)) faults.push_back({*std::move(fault)});
  }
  if (!absurd.any()) return faults;
  faults.push_back({DescribeAbsurd(measurements, absurd) +
                        "; cut that out, or take a loss that leaves it out (--set loss=huber, of "
                        "energy-ml and nominal-ls)",
                    true});
  return faults;
}

std::optional<std::string> JumpsThatReturn(const Measurements& m, const Selection&) {
  if (m.size() < kLongestJump || m.velocity.size() != m.size()) return std::nullopt;
  const Eigen::VectorXd steps =
      (m.position.tail(m.size() - 1) - m.position.head(m.size() - 1)).cwiseAbs();
  const double step = QuantileOf(steps, kUsual), speed = QuantileOf(m.velocity.cwiseAbs(), kUsual);
  Index jumps = 0, samples = 0, first = 0;
  for (Index i = 1; i + 1 < m.size(); ++i) {
    const Index back = BackAfter(m.position, i, step);
    if (back == 0) continue;
    const double least =
        (m.velocity.segment(i, back - i).array() - m.velocity[i - 1]).abs().minCoeff();
    if (!(least > kBeyond * speed)) continue;
    if (jumps++ == 0) first = i;
    samples += back - i;
    i = back;
  }
  if (jumps < static_cast<Index>(kFewest)) return std::nullopt;
  return fmt::format(
      "position and velocity jump away and come back {} times, for {} samples in all, first at "
      "{:.6g} s by {:.4g} {} and to {:.4g} {}, where 19 of 20 samples move slower than {:.4g} {}: "
      "messages were spoilt; leave these samples out of the file",
      jumps, samples, m.time[first], m.position[first] - m.position[first - 1],
      kPositionUnit.For(m.joint), m.velocity[first], kVelocityUnit.For(m.joint), speed,
      kVelocityUnit.For(m.joint));
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
