#include "tools/export/controller_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "tools/export/code_lines.h"

namespace warmjoint {
namespace {

/// UR's joints in the order of its arrays, which a prefix may precede.
constexpr std::array kUrJoints{"shoulder_pan_joint", "shoulder_lift_joint", "elbow_joint",
                               "wrist_1_joint",      "wrist_2_joint",       "wrist_3_joint"};

/// In double quotes, as JSON and YAML have it.
std::string Quoted(const std::string& name) { return nlohmann::json(name).dump(); }

// --- ROS 2

void RequireRosHolds(const SeenFriction& seen) {
  if (seen.joint.find('.') != std::string::npos) {
    Refuse({"joint " + Excerpt(seen.joint)},
           "has a point in its name, which ROS 2 reads as a level of parameters; rename it in the "
           "file");
  }
  if (seen.friction.maps.empty()) return;
  std::vector<std::string> over;
  for (const FrictionMap& map : seen.friction.maps) {
    for (const MapAxis& axis : map.axes) over.emplace_back(NameOf(axis.quantity));
  }
  Refuse({"joint " + Excerpt(seen.joint)},
         "has a map over {}, which single parameters of ROS 2 do not hold; compile the friction "
         "into the controller: warmjoint export FILE --to cpp",
         fmt::join(over, ", "));
}

// --- UR

/// The six in UR's order. Throws BadInput, by name.
std::vector<SeenFriction> InUrOrder(const std::vector<SeenFriction>& frictions) {
  std::vector<SeenFriction> ordered;
  for (const std::string_view name : kUrJoints) {
    const auto found = std::ranges::find_if(
        frictions, [&](const SeenFriction& one) { return one.joint.ends_with(name); });
    if (found == frictions.end()) {
      Refuse({"--to ur"},
             "has no friction of {}: a UR takes the scales of its six joints at once, {}; give the "
             "robot.json of identify-robot with all of them",
             name, fmt::join(kUrJoints, ", "));
    }
    ordered.push_back(*found);
  }
  if (frictions.size() != kUrJoints.size()) {
    Refuse({"--to ur"}, "has {} joints; a UR has six, {}", frictions.size(),
           fmt::join(kUrJoints, ", "));
  }
  return ordered;
}

/// share times warm over cold.
double ScaleOf(const EngineFriction& joint, std::string_view part, double share, double warm,
               double cold) {
  const double scale = cold > 0 ? share * warm / cold : 0;
  if (scale > 1) {
    Refuse({"joint " + Excerpt(joint.joint)},
           "needs {:.3g} of the robot's own {} compensation, and a UR takes 0 to 1: its friction "
           "grows with heat; compensate it in the commanded torque: warmjoint export FILE --to cpp",
           scale, part);
  }
  return scale;
}

std::string List(const std::vector<double>& scales) {
  // three digits: the shares have one
  return fmt::format("[{:.3f}]", fmt::join(scales, ", "));
}

/// A joint's friction and what its scales leave out, as comments.
std::string UrComments(const SeenFriction& seen, const EngineFriction& warm) {
  std::string text = fmt::format("#   {}: viscous {:.4g} N.m.s/rad, Coulomb {:.4g} N.m",
                                 Printable(seen.joint), warm.viscous, warm.level);
  for (const auto& [name, bounds] : seen.intervals) {
    text += fmt::format("; {} {:.6g} .. {:.6g}", name, bounds[0], bounds[1]);
  }
  text += '\n';
  for (const Omission& left : warm.left_out) {
    const std::string size = left.percent ? fmt::format(" {:+.3g} %", *left.percent) : "";
    text += fmt::format("#     left out: {}{}, {}\n", left.what, size, left.meaning);
  }
  return text;
}

}  // namespace

std::string RosText(const std::vector<SeenFriction>& frictions) {
  std::vector<std::string> names;
  std::string joints;
  for (const SeenFriction& seen : frictions) {
    RequireRosHolds(seen);
    const std::string name = Quoted(seen.joint.empty() ? "joint" : seen.joint);
    names.push_back(name);
    joints +=
        fmt::format("      {}:  # law {}{}\n", name, seen.friction.law, LeftOutOf(seen.friction));
    const CompensatorNumbers held(seen.friction, seen.doubt);
    for (const CodeLine& line : CodeLinesOf(seen, held.numbers())) {
      joints += fmt::format("        {}: {}{}\n", line.member, Literal(line.value),
                            CommentOf(line, seen, "#"));
    }
  }
  return fmt::format(
      "# friction with its 95 % intervals: the numbers of wj_friction, <warmjoint/compensate.h>\n"
      "friction_compensation_controller:\n  ros__parameters:\n    joints: [{}]\n    friction:\n{}",
      fmt::join(names, ", "), joints);
}

std::string UrText(const std::vector<SeenFriction>& frictions, const Warmth& warmth) {
  std::vector<double> viscous, coulomb;
  std::string comments;
  for (const SeenFriction& seen : InUrOrder(frictions)) {
    const EngineFriction cold = InEngine(seen, {0, warmth.speed}, EngineFormat::ur);
    const EngineFriction warm = InEngine(seen, warmth, EngineFormat::ur);
    const std::size_t at = viscous.size();
    viscous.push_back(ScaleOf(warm, "viscous", kUrViscousShares[at], warm.viscous, cold.viscous));
    coulomb.push_back(ScaleOf(warm, "Coulomb", kUrCoulombShares[at], warm.level, cold.level));
    comments += UrComments(seen, warm);
  }
  return fmt::format(
      "# ur_msgs/srv/SetFrictionModelParameters: UR's default shares times friction at warm {:.3g} "
      "over that of\n"
      "# the cold joint, for which its own model is taken. In URScript, each step:\n"
      "#   direct_torque(torque, viscous_scale={}, coulomb_scale={})\n{}"
      "parameters:\n  viscous_scale: {}\n  coulomb_scale: {}\n",
      warmth.share, List(viscous), List(coulomb), comments, List(viscous), List(coulomb));
}

}  // namespace warmjoint
