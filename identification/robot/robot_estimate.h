// robot.json as a tree.
#pragma once

#include <warmjoint/robot_estimate.h>

#include <filesystem>

#include "models/foundation/node.h"

namespace warmjoint {

/// Whether a file is a robot.json, and no estimate of one joint, friction or whatever else.
bool IsRobotEstimate(const Node& file);

/// target: the file that it is for (EstimateToTree).
Tree RobotEstimateToTree(const RobotEstimate& robot, const std::filesystem::path& target = {});

}  // namespace warmjoint
