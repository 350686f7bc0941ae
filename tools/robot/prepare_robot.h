// A robot's logs made ready for the fits of its joints: what stands out in all joints together is found, said and undone.
#pragma once

#include <warmjoint/identify_robot.h>

#include <optional>
#include <string>
#include <vector>

#include "identification/robot/common_columns.h"
#include "identification/robot/robot_joint.h"
#include "tools/robot/find_gravity.h"
#include "tools/robot/joint_data.h"
#include "tools/robot/robot_data.h"

namespace warmjoint {

/// A joint from its columns to its fit.
struct PreparedRobotJoint {
  JointColumns columns;
  RobotJointSummary summary;
  std::string nothing;                       // why its log tells nothing
  Status status = Status::not_identifiable;  // of that
  GainGuess guess;
  Eigen::MatrixXd late{};  // [N x 1] what stays open of a delay of all torques; or empty
};

/// All joints of a robot along all logs.
struct PreparedRobot {
  RobotData data;  // with signs and times as they are fitted
  RobotRows rows;
  std::vector<PreparedRobotJoint> joints;
  double middle_gain = 1;
  GravityFound gravity;
  std::optional<CommonFit> delay;  // s; its value is the whole
  std::vector<std::string> notices;

  /// Those with motion.
  std::vector<Eigen::Index> Moving() const;
};

/// Signs of torques by the friction that brakes, one sentence where all are turned; then, of the direction of gravity and a single fault of the
/// columns, what explains the log better; then a delay of all torques. A fault voids all joints, since the rigid torque of each follows from the
/// positions of all.
PreparedRobot Prepare(RobotData data, const RobotSettings& settings, const RobotWatch& tell);

/// Frees the last link, which may carry a load, and makes the joints anew; all begin at the gain that a load leaves least open (payload.h).
void FreeLoad(PreparedRobot& robot);

}  // namespace warmjoint
