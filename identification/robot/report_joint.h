// The estimate of a joint of a robot, with the causes that make it worthless or less certain than it seems.
#pragma once

#include <warmjoint/robot_estimate.h>

#include <string>

#include "identification/holdout/hold_out.h"
#include "identification/robot/robot_joint.h"

namespace warmjoint {

/// The error of a second fit on samples that it has not seen. Torques in the log's unit.
struct JointHoldOut {
  HeldOut held;  // away from reversals; without friction: gain times rigid torque and an offset
  double moving = 0;  // rms of all samples at which the joint moves
};

/// share: of the samples' end that is held out, 0: none. None either where too few samples are left on either side.
JointHoldOut HoldOutJoint(const JointFit& fit, const JointColumns& columns, double share);

/// Why the log does not determine the friction of a joint; empty where it may.
std::string WhyNothing(const JointColumns& columns, double travel);

/// A joint without an estimate.
RobotJointEstimate ReportNothing(const JointColumns& columns, RobotJointSummary summary,
                                 Status status, std::string message);

/// The estimate. Friction is in N.m (N) where the log has it so, or where the gain of its current is known; else in the log's unit.
RobotJointEstimate ReportJoint(const JointFit& fit, const JointColumns& columns,
                               RobotJointSummary summary, const JointHoldOut& holdout);

}  // namespace warmjoint
