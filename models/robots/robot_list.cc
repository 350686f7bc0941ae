#include "models/robots/robot_list.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/read_json.h"
#include "models/friction/friction_json.h"
#include "models/robots/read_urdf.h"
#include "models/robots/robot_folder.h"

namespace warmjoint {
namespace {

namespace fs = std::filesystem;

/// The heading of a README: its first line without the mark.
std::string ReadHeading(const fs::path& readme) {
  const std::string text = ReadWholeFile(readme);
  const std::string line = text.substr(0, text.find('\n'));
  if (!line.starts_with("# ") || line.size() < 3) {
    Refuse({readme.string(), 1}, "must begin with '# ' and one line on what the robot is");
  }
  return line.substr(2);
}

RobotJoint Describe(const urdf::Joint& joint) {
  RobotJoint result;
  result.name = joint.name;
  if (joint.type == urdf::Joint::PRISMATIC) result.kind = JointKind::linear;
  // what the URDF says of limits; a continuous joint turns without end
  result.limits = {-kInfinity, kInfinity};
  if (!joint.limits) return result;
  if (joint.type != urdf::Joint::CONTINUOUS) {
    result.limits = {joint.limits->lower, joint.limits->upper};
  }
  result.effort = joint.limits->effort;
  result.speed = joint.limits->velocity;
  return result;
}

/// The movable joints below a link, parents first.
void CollectJoints(const urdf::Link& link, std::vector<RobotJoint>& joints) {
  // this link's joints before those of its children
  for (const urdf::JointSharedPtr& joint : link.child_joints) {
    if (joint->type != urdf::Joint::FIXED) joints.push_back(Describe(*joint));
  }
  for (const urdf::LinkSharedPtr& child : link.child_links) CollectJoints(*child, joints);
}

std::string ReadFrictionJoint(const fs::path& path, const std::vector<RobotJoint>& joints) {
  // the joint that the friction file is for
  const nlohmann::json file = ReadJsonFile(path);
  const std::string name =
      file.contains("joint") && file["joint"].is_string() ? file["joint"].get<std::string>() : "";
  const bool known = std::any_of(joints.begin(), joints.end(),
                                 [&](const RobotJoint& joint) { return joint.name == name; });
  if (!known)
    Refuse({path.string()}, "joint is '{}', which is none of the robot's joints", Excerpt(name));
  return name;
}

RobotInfo ReadRobot(const std::string& name) {
  const fs::path folder = DataFolder() / "models" / "robots" / name;
  // its files, by their names in its folder
  RobotInfo robot;
  robot.name = name;
  // what they say of it
  robot.description = ReadHeading(folder / "README.md");
  robot.mjcf = folder / (name + ".xml");
  robot.urdf = folder / (name + ".urdf");
  CollectJoints(*ReadUrdf(robot.urdf)->getRoot(), robot.joints);
  robot.friction = ReadFriction(folder / "friction.json");
  robot.friction_joint = ReadFrictionJoint(folder / "friction.json", robot.joints);
  return robot;
}

}  // namespace

std::vector<RobotInfo> Robots() {
  std::vector<RobotInfo> robots;
  for (const std::string& name : RobotNames()) robots.push_back(ReadRobot(name));
  return robots;
}

}  // namespace warmjoint
