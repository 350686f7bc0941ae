// The picture of a joint of a robot.
#pragma once

#include <warmjoint/robot_estimate.h>

#include <optional>

#include "tools/figures/figure.h"

namespace warmjoint::figures {

/// Friction over velocity, along the log, and what is left; nothing of a joint without a fit.
std::optional<Figure> MakeJointFigure(const RobotJointEstimate& joint);

}  // namespace warmjoint::figures
