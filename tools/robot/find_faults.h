// What a log of a robot may have wrong in one place: columns swapped, a sign turned, degrees, the motor's side.
#pragma once

#include <Eigen/LU>
#include <string>
#include <vector>

#include "tools/robot/joint_data.h"
#include "tools/robot/robot_data.h"

namespace warmjoint {

/// A fault by which joints follow the description better once it is undone.
struct RobotFault {
  std::string sentence;
  std::vector<Eigen::Index> joints;  // whose residual falls by a factor of 2 or more
};

/// Fits each joint by least squares with the description as it is, and again with each single fault undone: the columns of two joints
/// swapped, the position of one turned, all angles in degrees taken as rad, a gear that the positions still hold. The one by which
/// the residuals fall most is named, where one falls by half at least and none rises. A turned torque is told by the gain (ReportJoint); zeros that are off,
/// and signs of joints that carry nothing, cannot be told.
std::vector<RobotFault> FindFaults(const RobotData& data, const RobotRows& rows,
                                   const NumberOfJoints& gears);

}  // namespace warmjoint
