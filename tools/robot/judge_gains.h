// Whether the torques of a robot in N.m or N can be those of its description: their gains.
#pragma once

#include "tools/robot/prepare_robot.h"

namespace warmjoint {

/// Refuses joints whose gain is below a third with all of its error, since a load that the description lacks makes no gain so small: a torque of
/// the motor's side, or of another unit. Where all known gains agree on such a factor, one sentence refuses all. Not with a description that may be
/// wrong by more than half (`inertials`).
void JudgeSmallGains(const RobotSettings& settings, PreparedRobot& robot);

/// Refuses those above 3 alike, and says which gains are outside 1/1.4 to 1.4, or apart from those of the other joints by as much. After the
/// search for a load, which makes gains large.
void JudgeGains(const RobotSettings& settings, PreparedRobot& robot);

}  // namespace warmjoint
