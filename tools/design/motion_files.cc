// A motion as files of robots' controllers.
#include <fmt/format.h>
#include <warmjoint/design.h>

#include <algorithm>
#include <cmath>

#include "models/foundation/serialize.h"
#include "tools/design/aim.h"

namespace warmjoint {
namespace {

std::string Row(const MotionKnot& knot) {
  // to nine decimals: sums of strokes about 0 leave less
  const auto rounded = [](double value) { return std::round(1e9 * value) / 1e9 + 0.0; };
  return fmt::format("{:.10g},{:.10g},{:.10g}\n", rounded(knot.time), rounded(knot.position),
                     rounded(knot.velocity));
}

constexpr const char* kHeader = "time,position,velocity\n";

std::string Knots(const Design& design) {
  std::string text = kHeader;
  for (const MotionKnot& knot : design.knots) text += Row(knot);
  return text;
}

/// The motion at a time between two knots.
MotionKnot Between(const MotionKnot& from, const MotionKnot& to, double time) {
  const double lasts = to.time - from.time, after = time - from.time;
  const double slope = lasts > 0 ? (to.velocity - from.velocity) / lasts : 0;
  return {time, from.position + after * (from.velocity + slope * after / 2),
          from.velocity + slope * after};
}

std::string SetPoints(const Design& design) {
  std::string text = kHeader;
  const double rate = design.settings.rate;
  const auto n = static_cast<long>(std::floor(design.knots.back().time * rate + 1e-9));
  size_t next = 1;
  for (long i = 0; i <= n; ++i) {
    const double time = static_cast<double>(i) / rate;
    while (next + 1 < design.knots.size() && design.knots[next].time < time) ++next;
    text += Row(Between(design.knots[next - 1], design.knots[next], time));
  }
  return text;
}

/// trajectory_msgs/JointTrajectory; between its points a controller's cubic spline is this motion exactly.
std::string Trajectory(const Design& design, const std::string& joint) {
  std::string text = fmt::format("joint_names: [{}]\npoints:\n", Tree(joint).dump());
  for (const MotionKnot& knot : design.knots) {
    const auto nanoseconds = std::llround(1e9 * knot.time);
    text += fmt::format(
        "- {{positions: [{:.9g}], velocities: [{:.9g}], time_from_start: {{sec: {}, nanosec: "
        "{}}}}}\n",
        knot.position, knot.velocity, nanoseconds / 1'000'000'000, nanoseconds % 1'000'000'000);
  }
  return text;
}

/// movej from rest to rest, whose ramps are those of the limits.
std::string UrScript(const Design& design) {
  std::string text =
      "def warm_up_motion():\n"
      "  # 0: base, ..., 5: wrist 3; the others stay where they are\n"
      "  joint = 0\n"
      "  q = get_actual_joint_positions()\n";
  const auto move = [&](const MotionKnot& knot, double speed) {
    text += fmt::format("  q[joint] = {:.6f}\n  movej(q, a={:.6g}, v={:.6g})\n", knot.position,
                        design.settings.limits.acceleration, speed);
  };
  // slowly to the place where it begins
  move(design.knots.front(), design.settings.limits.velocity[0]);
  double speed = 0;
  for (size_t k = 1; k < design.knots.size(); ++k) {
    const MotionKnot &from = design.knots[k - 1], &to = design.knots[k];
    speed = std::max(speed, std::abs(to.velocity));
    if (to.velocity != 0) continue;
    if (from.velocity == 0) {
      text += fmt::format("  sleep({:.6g})\n", to.time - from.time);
    } else {
      move(to, speed);
    }
    speed = 0;
  }
  return text + "end\n";
}

}  // namespace

std::vector<std::pair<std::string, std::string>> FilesOf(const Design& design,
                                                         const std::string& joint) {
  std::vector<std::pair<std::string, std::string>> files{
      {"design.json", WriteFields(design).dump(1) + "\n"},
      {"motion.csv", Knots(design)},
      {"setpoints.csv", SetPoints(design)},
      {"trajectory.yaml", Trajectory(design, joint)}};
  if (design.settings.joint == JointKind::rotary)
    files.push_back({"motion.script", UrScript(design)});
  return files;
}

}  // namespace warmjoint
