#include "identification/robot/robot_estimate.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "identification/estimate.h"
#include "models/foundation/serialize.h"

namespace warmjoint {

const RobotJointEstimate* RobotEstimate::Find(std::string_view joint) const {
  const auto found = std::ranges::find(
      joints, joint, [](const RobotJointEstimate& one) { return one.summary.joint; });
  return found == joints.end() ? nullptr : &*found;
}

Tree RobotEstimateToTree(const RobotEstimate& robot, const std::filesystem::path& target) {
  Tree joints = Tree::object(), summary = Tree::object();
  for (const RobotJointEstimate& one : robot.joints) {
    joints[one.summary.joint] = EstimateToTree(one.estimate, target);
    summary[one.summary.joint] = WriteFields(RobotJointSummary(one.summary));
  }
  Tree tree = Tree::object();
  tree["robot"] = robot.robot;
  tree["log"] = robot.log;
  tree["notices"] = robot.notices;
  tree["payload"] = robot.payload ? WriteFields(EstimatedParameter(*robot.payload)) : Tree();
  tree["gravity"] = robot.gravity ? WriteFields(BaseGravity(*robot.gravity)) : Tree();
  tree["gravity_taken_off"] = robot.gravity_taken_off;
  tree["delay"] = robot.delay ? WriteFields(EstimatedParameter(*robot.delay)) : Tree();
  tree["summary"] = std::move(summary);
  tree["joints"] = std::move(joints);
  return tree;
}

std::string RobotEstimateToJson(const RobotEstimate& robot, const std::filesystem::path& target) {
  return RobotEstimateToTree(robot, target).dump(2) + "\n";
}

bool IsRobotEstimate(const Node& file) {
  return file.IsMap() && file.Find("joints") && file.Find("summary");
}

RobotEstimate ReadRobotEstimate(const std::filesystem::path& file) {
  const Node node = ReadJsonNode(file).With(UnknownKeys::ignored);
  RobotEstimate robot;
  const Node joints = node.Require("joints", "give the joints of a robot.json of identify-robot");
  const std::optional<Node> summaries = node.Find("summary");
  for (const std::string& name : joints.Keys()) {
    RobotJointEstimate one;
    const std::optional<Node> estimate = joints.Find(name);
    if (!estimate) continue;
    one.estimate = EstimateFrom(*estimate);
    const std::optional<Node> summary = summaries ? summaries->Find(name) : std::nullopt;
    if (summary) one.summary = ReadAs<RobotJointSummary>(*summary);
    one.summary.joint = name;
    robot.joints.push_back(std::move(one));
  }
  const auto texts = [&](const char* key) {
    std::vector<std::string> found;
    const std::optional<Node> list = node.Find(key);
    if (!list) return found;
    for (const Node& entry : list->Entries("give texts")) found.push_back(entry.Text());
    return found;
  };
  if (const auto load = node.Find("payload")) {
    robot.payload = ReadAs<EstimatedParameter>(*load);
    robot.payload->name = "payload";
  }
  if (const auto gravity = node.Find("gravity")) robot.gravity = ReadAs<BaseGravity>(*gravity);
  if (const auto taken = node.Find("gravity_taken_off")) {
    ReadValue(*taken, &robot.gravity_taken_off, {});
  }
  if (const auto delay = node.Find("delay")) {
    robot.delay = ReadAs<EstimatedParameter>(*delay);
    robot.delay->name = "delay";
  }
  if (const auto name = node.Find("robot")) robot.robot = name->Text();
  robot.log = texts("log");
  robot.notices = texts("notices");
  return robot;
}

}  // namespace warmjoint
