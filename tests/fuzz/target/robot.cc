// A robot's description and its log: a line that says which end the description's name has, the description, a line "----", the log.
#include <warmjoint/identify_robot.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "identification/robot/robot_estimate.h"
#include "tests/fuzz/fuzz.h"

void warmjoint::fuzz::Read(std::string_view bytes) {
  constexpr std::string_view border = "\n----\n";
  const bool urdf = fuzz::TakeLine(bytes) == "urdf";
  const std::size_t end = std::min(bytes.find(border), bytes.size());
  const fuzz::ScratchFile robot(bytes.substr(0, end), urdf ? ".urdf" : ".xml");
  bytes.remove_prefix(std::min(end + border.size(), bytes.size()));
  const fuzz::ScratchFile log(bytes, ".csv");

  const RobotEstimate answer = IdentifyRobot(robot.path(), {{log.path().string()}});
  fuzz::Require(!answer.joints.empty());
  for (const RobotJointEstimate& one : answer.joints) {
    fuzz::Require(!one.summary.joint.empty());
    for (const EstimatedParameter& parameter : one.estimate.parameters) {
      fuzz::Require(std::isfinite(parameter.value));
    }
  }
  // what is written is text, and is read back
  const fuzz::ScratchFile file(RobotEstimateToJson(answer), ".json");
  fuzz::Require(ReadRobotEstimate(file.path()).joints.size() == answer.joints.size());
}
