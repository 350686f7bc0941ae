// What a log of a robot may have wrong in one place: columns swapped, a sign turned, a zero that is off, degrees, the motor's side.
#pragma once

#include <string>
#include <vector>

#include "tools/robot/joint_data.h"
#include "tools/robot/robot_data.h"

namespace warmjoint {

/// A fault by which joints follow the description better once it is undone.
struct RobotFault {
  std::string sentence;
  std::vector<Eigen::Index> joints;  // whose residual falls by a factor of 2 or more
  double falls = 0;  // sum over the joints of the logarithms by which their residuals fall
};

/// Fits each joint by least squares with the description as it is, and again with each single fault undone: the positions, torques or both of two
/// joints swapped, the position of one turned or its zero off, all angles in degrees taken as rad, a gear that the positions still hold. The one by
/// which the residuals fall most is named, where one falls by half at least, none rises, and friction stands out of all joints that it is about:
/// what does not repair its joints is something else (legs that touch the ground),
/// and what a load at the last link explains as well is left to it. A turned torque is told by the gain (ReportJoint); signs and
/// zeros of joints that carry nothing cannot be told.
std::vector<RobotFault> FindFaults(const RobotData& data, const RobotRows& rows,
                                   const NumberOfJoints& gears);

}  // namespace warmjoint
