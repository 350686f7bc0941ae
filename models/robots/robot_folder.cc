#include "models/robots/robot_folder.h"

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/description_text.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/names.h"
#include "models/foundation/node.h"
#include "models/foundation/parse_number.h"
#include "models/foundation/xml_tags.h"

namespace warmjoint {
namespace fs = std::filesystem;
namespace {

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
  const Tree file = ReadJsonFile(path);
  const std::string name =
      file.contains("joint") && file["joint"].is_string() ? file["joint"].get<std::string>() : "";
  if (std::ranges::find(joints, name, &RobotJoint::name) == joints.end())
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

constexpr double kLargest = std::numeric_limits<double>::max();

/// The text with the largest number in place of an infinite limit, which urdfdom refuses.
std::string WithFiniteLimits(const std::string& text) {
  std::string written;
  std::size_t copied = 0;
  XmlTagReader reader(text);
  while (const auto tag = reader.Next()) {
    if (tag->name != "limit") continue;
    for (const auto& [name, value] : tag->Attributes()) {
      const auto number = ParseNumber(value);
      if (!number || !std::isinf(*number)) continue;
      const auto at = static_cast<std::size_t>(value.data() - text.data());
      written += text.substr(copied, at - copied);
      written += fmt::format("{}", std::copysign(kLargest, *number));
      copied = at + value.size();
    }
  }
  return written + text.substr(copied);
}

/// Keeps what urdfdom would print.
class Collector : public console_bridge::OutputHandler {
 public:
  Collector() { console_bridge::useOutputHandler(this); }
  ~Collector() override { console_bridge::restorePreviousOutputHandler(); }

  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level < console_bridge::CONSOLE_BRIDGE_LOG_ERROR) return;
    if (!errors.empty()) errors += "; ";
    errors += text;
  }

  std::string errors;
};

}  // namespace

std::vector<std::string> RobotNames() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(DataFolder() / "models" / "robots")) {
    const std::string name = entry.path().filename();
    if (fs::exists((entry.path() / name).replace_extension(".xml"))) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

fs::path FindRobot(const std::string& name_or_path, const std::string& asked_by) {
  const bool is_path =
      name_or_path.find('/') != std::string::npos || fs::path(name_or_path).has_extension();
  // a file of the user's
  if (is_path) {
    if (fs::is_regular_file(name_or_path)) return name_or_path;
    Refuse({asked_by},
           "robot '{}' is neither a file nor a robot's name; give an MJCF or URDF file, or one of "
           "`warmjoint list robots`",
           name_or_path);
  }
  // a robot of the project, by its name
  const std::vector<std::string> names = RobotNames();
  if (std::find(names.begin(), names.end(), name_or_path) == names.end()) {
    Refuse({asked_by}, "there is no robot '{}'{}", Excerpt(name_or_path),
           Suggestion(name_or_path, names));
  }
  return DataFolder() / "models" / "robots" / name_or_path /
         fs::path(name_or_path).replace_extension(".xml");
}

std::vector<RobotInfo> Robots() {
  std::vector<RobotInfo> robots;
  for (const std::string& name : RobotNames()) robots.push_back(ReadRobot(name));
  return robots;
}

urdf::ModelInterfaceSharedPtr ReadUrdf(const std::filesystem::path& path) {
  // urdfdom reports through one handler of the whole program
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);

  // read, checked and parsed, with what the parser says kept for the refusal
  const std::string text = WithFiniteLimits(ReadDescription(path).text);
  Collector collector;
  urdf::ModelInterfaceSharedPtr robot = urdf::parseURDF(text);
  const Place place{path.string()};
  if (!robot) Refuse(place, "cannot be used as URDF: {}", collector.errors);
  for (const auto& [name, joint] : robot->joints_) {
    if (!joint->limits) continue;
    urdf::JointLimits& limits = *joint->limits;
    for (double* limit : {&limits.lower, &limits.upper, &limits.effort, &limits.velocity}) {
      if (std::abs(*limit) == kLargest) *limit = std::copysign(kInfinity, *limit);
    }
  }
  for (const auto& [name, link] : robot->links_) RequireName("the name of a link", name, place);
  for (const auto& [name, joint] : robot->joints_) RequireName("the name of a joint", name, place);
  return robot;
}

}  // namespace warmjoint
