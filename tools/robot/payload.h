// A load at the last link that nobody told: whether the log shows one.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "identification/robot/robot_joint.h"
#include "tools/robot/joint_data.h"
#include "tools/robot/robot_data.h"

namespace warmjoint {

/// A load of some kg at the last link.
struct Payload {
  double falls = 1;  // held-out residual of the joint that it helps most, over that without it
  bool is_shown = false;
  std::optional<EstimatedParameter>
      mass;  // kg, with its interval, of all joints together; where shown or asked for
};

/// Gains at which fits with a free last link begin.
struct LoadedGains {
  std::vector<GainGuess> guesses;  // [n] with the signs of those without a load
  double middle = 1;
};

/// A load that the description lacks spoils the gains of joints that carry little else, those of wrists. In N.m or N all begin at 1; in A at the gain
/// of the joint, of those that are sure, whose torque the free last link leaves least open. guesses: [n]; free: [n] columns of the same joints with the
/// last link free.
LoadedGains GainsUnderLoad(std::vector<GainGuess> guesses,
                           const std::vector<const JointColumns*>& free);

/// The prior with a last link that may carry a load: a fifth of all that moves, within a fifth of the reach. [10 L x 10 L]
Eigen::MatrixXd FreeLastLink(const RobotData& data, const Eigen::MatrixXd& deviations);

/// Fits each joint with and without a free last link, and compares them on held-out samples: a load is shown where the residual of one joint falls
/// by a third, the product of all joints' as well, and its mass is above 0 with the whole interval. Its mass is what all joints say together (FitShared), with a description that may be wrong elsewhere too;
/// it is computed where a load is shown or `tool` is unknown. guesses: [n] gains; question: as of the joints' fits. joints: those that have a fit.
Payload FindPayload(const RobotData& data, const RobotRows& rows,
                    const std::vector<GainGuess>& guesses, const std::vector<Eigen::Index>& joints,
                    JointQuestion question, ToolKnown tool);

/// What is said of a load that is shown.
std::string ExplainPayload(const Payload& payload, ToolKnown tool);

}  // namespace warmjoint
