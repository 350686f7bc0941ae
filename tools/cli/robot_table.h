// The friction of a robot's joints for people.
#pragma once

#include <warmjoint/robot_estimate.h>

#include <string>

#include "tools/terminal/say.h"

namespace warmjoint {

/// A row for each joint: verdict, friction with 95 % half widths, warming, residual on held-out samples; below it what is to be said of
/// each.
std::string RobotToText(const RobotEstimate& robot, const Page& page);

}  // namespace warmjoint
