// A motion as files of robots' controllers.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <warmjoint/design.h>

#include <algorithm>
#include <cmath>

#include "models/foundation/serialize.h"
#include "tools/design/aim.h"
#include "tools/design/motion_plan.h"

namespace warmjoint {
namespace {

/// A joint's motion in files of several.
struct Track {
  std::string joint;
  const std::vector<MotionKnot>* knots;
};

/// Where all joints are at ascending times: a call for each time with its knots, in the order of the tracks.
template <class Visit>
void Along(const std::vector<Track>& tracks, const std::vector<double>& times, const Visit& visit) {
  std::vector<size_t> next(tracks.size(), 1);
  std::vector<MotionKnot> now(tracks.size());
  for (const double time : times) {
    for (size_t j = 0; j < tracks.size(); ++j) {
      const std::vector<MotionKnot>& knots = *tracks[j].knots;
      while (next[j] + 1 < knots.size() && knots[next[j]].time < time) ++next[j];
      now[j] = Between(knots[next[j] - 1], knots[next[j]], time);
    }
    visit(time, now);
  }
}

/// The times of all tracks' knots; of those nearer than a nanosecond the first.
std::vector<double> KnotTimes(const std::vector<Track>& tracks) {
  std::vector<double> times;
  for (const Track& track : tracks) {
    for (const MotionKnot& knot : *track.knots) times.push_back(knot.time);
  }
  std::ranges::sort(times);
  const auto repeated = std::ranges::unique(times, [](double a, double b) { return b - a < 1e-9; });
  times.erase(repeated.begin(), repeated.end());
  return times;
}

std::vector<double> SampleTimes(const std::vector<Track>& tracks, double rate) {
  const double end = tracks.front().knots->back().time;
  std::vector<double> times(static_cast<size_t>(std::floor(end * rate + 1e-9)) + 1);
  for (size_t i = 0; i < times.size(); ++i) times[i] = static_cast<double>(i) / rate;
  return times;
}

/// time, position and velocity; of several joints by their names.
std::string Csv(const std::vector<Track>& tracks, const std::vector<double>& times) {
  std::string text = "time";
  for (const Track& track : tracks) {
    const std::string prefix = tracks.size() > 1 ? track.joint + "_" : "";
    text += fmt::format(",{0}position,{0}velocity", prefix);
  }
  text += '\n';
  Along(tracks, times, [&](double time, const std::vector<MotionKnot>& now) {
    text += fmt::format("{:.14g}", AsInFiles(time));
    for (const MotionKnot& knot : now) {
      text += fmt::format(",{:.14g},{:.14g}", AsInFiles(knot.position), AsInFiles(knot.velocity));
    }
    text += '\n';
  });
  return text;
}

/// trajectory_msgs/JointTrajectory; between its points a controller's cubic spline is this motion exactly.
std::string Trajectory(const std::vector<Track>& tracks) {
  std::vector<std::string> names;
  for (const Track& track : tracks) names.push_back(Tree(track.joint).dump());
  std::string text = fmt::format("joint_names: [{}]\npoints:\n", fmt::join(names, ", "));
  Along(tracks, KnotTimes(tracks), [&](double time, const std::vector<MotionKnot>& now) {
    std::vector<std::string> positions, velocities;
    for (const MotionKnot& knot : now) {
      positions.push_back(fmt::format("{:.9g}", AsInFiles(knot.position)));
      velocities.push_back(fmt::format("{:.9g}", AsInFiles(knot.velocity)));
    }
    const auto nanoseconds = std::llround(1e9 * time);
    text += fmt::format(
        "- {{positions: [{}], velocities: [{}], time_from_start: {{sec: {}, nanosec: {}}}}}\n",
        fmt::join(positions, ", "), fmt::join(velocities, ", "), nanoseconds / 1'000'000'000,
        nanoseconds % 1'000'000'000);
  });
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

/// The motion as files.
std::vector<std::pair<std::string, std::string>> MotionFiles(const std::vector<Track>& tracks,
                                                             double rate) {
  return {{"motion.csv", Csv(tracks, KnotTimes(tracks))},
          {"setpoints.csv", Csv(tracks, SampleTimes(tracks, rate))},
          {"trajectory.yaml", Trajectory(tracks)}};
}

}  // namespace

std::vector<std::pair<std::string, std::string>> FilesOf(const Design& design,
                                                         const std::string& joint) {
  auto files = MotionFiles({{joint, &design.knots}}, design.settings.rate);
  files.insert(files.begin(), {"design.json", WriteFields(design).dump(1) + "\n"});
  if (design.settings.joint == JointKind::rotary)
    files.push_back({"motion.script", UrScript(design)});
  return files;
}

std::vector<std::pair<std::string, std::string>> FilesOf(const RobotDesign& design) {
  if (design.joints.size() == 1) {
    return FilesOf(design.joints.front(), design.joints.front().name);
  }
  std::vector<Track> tracks;
  for (const JointDesign& one : design.joints) tracks.push_back({one.name, &one.knots});
  auto files = MotionFiles(tracks, design.joints.front().settings.rate);
  files.insert(files.begin(), {"design.json", WriteFields(design).dump(1) + "\n"});
  return files;
}

}  // namespace warmjoint
