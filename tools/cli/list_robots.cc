#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "models/robots/robot_list.h"
#include "tools/board/table.h"
#include "tools/cli/families.h"

namespace warmjoint::inline tools {
namespace {

using nlohmann::ordered_json;

ordered_json Limit(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

ordered_json JointJson(const RobotJoint& joint) {
  return {{"name", joint.name},
          {"kind", joint.kind == JointKind::linear ? "linear" : "rotary"},
          {"lower", Limit(joint.limits.first)},
          {"upper", Limit(joint.limits.second)},
          {"effort", joint.effort},
          {"speed", joint.speed}};
}

}  // namespace

ordered_json RobotsJson() {
  ordered_json all = ordered_json::array();
  for (const RobotInfo& robot : Robots()) {
    ordered_json joints = ordered_json::array();
    for (const RobotJoint& joint : robot.joints) joints.push_back(JointJson(joint));
    all.push_back({{"name", robot.name},
                   {"description", robot.description},
                   {"mjcf", robot.mjcf.string()},
                   {"urdf", robot.urdf.string()},
                   {"joints", joints},
                   {"friction", {{"joint", robot.friction_joint}, {"gear", robot.friction.gear}}}});
  }
  return all;
}

std::string RobotsText() {
  std::string text;
  for (const RobotInfo& robot : Robots()) {
    text += fmt::format("{}  {}\n", robot.name, robot.description);
    Table table{{"  joint", "unit", "from", "to", "speed", "effort", "friction file"}, {}};
    for (const RobotJoint& joint : robot.joints) {
      const std::string_view unit = kPositionUnit.For(joint.kind);
      table.rows.push_back(
          {"  " + joint.name, std::string(unit), fmt::format("{:.4g}", joint.limits.first),
           fmt::format("{:.4g}", joint.limits.second),
           fmt::format("{:.4g} {}/s", joint.speed, unit),
           fmt::format("{:g} {}", joint.effort, kTorqueUnit.For(joint.kind)),
           joint.name == robot.friction_joint ? fmt::format("gear {:g}", robot.friction.gear)
                                              : ""});
    }
    text += TableToText(table, 2) + "\n";
  }
  return text;
}

}  // namespace warmjoint::inline tools
