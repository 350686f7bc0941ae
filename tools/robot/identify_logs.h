// identify-robot of logs that are files or columns in memory.
#pragma once

#include <warmjoint/identify_robot.h>

#include <filesystem>

#include "tools/robot/robot_data.h"

namespace warmjoint {

/// IdentifyRobot of logs of either kind, each from a cold start. Throws BadInput.
RobotEstimate IdentifyRobot(const std::filesystem::path& robot, const RobotSource& source,
                            const RobotSettings& settings, const RobotWatch& watch);

}  // namespace warmjoint
