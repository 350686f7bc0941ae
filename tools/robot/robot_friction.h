// The frictions of a robot's answer in its model.
#pragma once

#include <warmjoint/identify_robot.h>

#include <filesystem>
#include <string>
#include <vector>

#include "sim/model/attach_text.h"

namespace warmjoint {

/// The frictions of all joints of robot.json. constants: N.m/A or N/A of joints whose friction is in amperes. initial: heat at the start
/// (InitialEnergies). Says in `warnings` which joints have none. Throws BadInput for a friction in amperes without a constant, by its joint's name, and
/// where no joint has a friction.
std::vector<FrictionForJoint> FrictionsOfRobot(const std::filesystem::path& file,
                                               const NumberOfJoints& constants,
                                               const std::string& initial,
                                               std::vector<std::string>& warnings);

/// The robot, for `out`, with the frictions that are known in N.m or N, and their rotors as armatures. The notices say which joints are left
/// out, and what attaching changed. Throws BadInput where none is left.
AttachedText WarmModel(const std::filesystem::path& robot, const RobotEstimate& estimate,
                       const std::filesystem::path& out);

}  // namespace warmjoint
