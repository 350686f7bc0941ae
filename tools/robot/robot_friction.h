// The frictions of a robot's answer in its model.
#pragma once

#include <warmjoint/attach.h>
#include <warmjoint/identify_robot.h>

#include <filesystem>
#include <string>
#include <vector>

namespace warmjoint {

/// The frictions of all joints of robot.json. constants: N.m/A or N/A of joints whose friction is in amperes. initial: heat at the start
/// (InitialEnergies). Says in `warnings` which joints have none. Throws BadInput for a friction in amperes without a constant, by its joint's name, and
/// where no joint has a friction.
std::vector<FrictionForJoint> FrictionsOfRobot(const std::filesystem::path& file,
                                               const NumberOfJoints& constants,
                                               const std::string& initial,
                                               std::vector<std::string>& warnings);

/// Writes the robot with the frictions that are known in N.m or N, and their rotors as armatures. Returns what is to be said, one sentence
/// each: which joints are left out, and what attaching changed. Throws BadInput where none is left.
std::vector<std::string> WriteWarmModel(const std::filesystem::path& robot,
                                        const RobotEstimate& estimate,
                                        const std::filesystem::path& out);

}  // namespace warmjoint
