#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "models/foundation/number_json.h"
#include "models/robots/robot_list.h"
#include "tools/cli/families.h"
#include "tools/terminal/table.h"
#include "tools/terminal/wrap.h"

namespace warmjoint::inline tools {
namespace {

using nlohmann::ordered_json;

ordered_json JointJson(const RobotJoint& joint) {
  return {{"name", joint.name},
          {"kind", joint.kind == JointKind::linear ? "linear" : "rotary"},
          {"lower", NumberOrNull(joint.limits.first)},
          {"upper", NumberOrNull(joint.limits.second)},
          {"effort", joint.effort},
          {"speed", joint.speed}};
}

}  // namespace

ordered_json RobotsJson() {
  ordered_json all = ordered_json::array();
  for (const RobotInfo& robot : Robots()) {
    // its joints, and which of them the friction file is for
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

std::string RobotText(const ordered_json& robot, int width) {
  // what it is, then a line for each joint
  std::string text = Wrap(fmt::format("{}  {}\n", robot["name"].get<std::string>(),
                                      robot["description"].get<std::string>()),
                          width, 4);
  Table table{{"  joint", "unit", "from", "to", "speed", "effort", "friction file"}, {}};
  for (const ordered_json& joint : robot["joints"]) {
    // a joint that turns for ever has no limits
    const auto limit = [&](const char* key, const char* none) {
      return joint[key].is_null() ? std::string(none)
                                  : fmt::format("{:.4g}", joint[key].get<double>());
    };
    const JointKind kind = joint["kind"] == "linear" ? JointKind::linear : JointKind::rotary;
    const std::string_view unit = kPositionUnit.For(kind);
    const ordered_json& friction = robot["friction"];
    table.rows.push_back(
        {"  " + joint["name"].get<std::string>(), std::string(unit), limit("lower", "-inf"),
         limit("upper", "inf"), fmt::format("{:.4g} {}/s", joint["speed"].get<double>(), unit),
         fmt::format("{:g} {}", joint["effort"].get<double>(), kTorqueUnit.For(kind)),
         joint["name"] == friction["joint"]
             ? fmt::format("gear {:g}", friction["gear"].get<double>())
             : ""});
  }
  return text + TableToText(table, 2, width);
}

}  // namespace warmjoint::inline tools
