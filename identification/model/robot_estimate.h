// robot.json as a tree.
#pragma once

#include <warmjoint/robot_estimate.h>

#include <filesystem>

#include "models/foundation/node.h"

namespace warmjoint {

/// target: the file that it is for (EstimateToTree).
Tree RobotEstimateToTree(const RobotEstimate& robot, const std::filesystem::path& target = {});

}  // namespace warmjoint
