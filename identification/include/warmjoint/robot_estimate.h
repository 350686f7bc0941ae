// The friction of all joints of a robot: robot.json as a value.
#pragma once

#include <warmjoint/estimate.h>

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace warmjoint {

/// The row of an offset of a joint's torque, which is no friction, among its parameters.
inline constexpr const char* kTorqueOffset = "torque_offset";

/// What is reported of a joint in addition to its estimate. Torques in the log's unit.
struct RobotJointSummary {
  std::string joint;
  std::string torque_unit;
  double travel = 0;           // rad or m
  double top_speed = 0;        // rad/s or m/s
  double minutes = 0;          // of clear motion
  std::optional<double> gain;  // torque_unit for N.m or N of the description's torque
  bool gain_is_known = false;  // to a factor of less than 1.5
  std::optional<double>
      rms_held_out;  // on samples away from reversals that a second fit has not seen
  std::optional<double> rms_moving;            // the same on all samples in motion
  std::optional<double> rms_without_friction;  // held out: gain times rigid torque and an offset
  /// [10 L] of the links from the base on, the description's as this joint's fit mends them: what RobotLink::parameters has
  std::vector<double> inertials{};

  /// Its fields without the name, which is the key in a file.
  template <class A>
  void Serialize(A* a) {
    a->Field("torque_unit", &torque_unit, {.needed = "give it as text"});
    a->Field("travel", &travel, Needed("rad", "of the joint, or of the motor of a coupled one"));
    a->Field("top_speed", &top_speed, Needed("rad/s", "after the low-pass"));
    a->Field("minutes", &minutes, Needed("min", "of motion away from rests and reversals"));
    a->Field("gain", &gain, OrNull("of the log's torque over that of the description"));
    a->Field("gain_is_known", &gain_is_known, {.meaning = "to a factor of less than 1.5"});
    a->Field("rms_held_out", &rms_held_out,
             OrNull("of the residual where a second fit has not seen the samples, torque_unit"));
    a->Field("rms_moving", &rms_moving, OrNull("the same with samples beside reversals"));
    a->Field("rms_without_friction", &rms_without_friction,
             OrNull("the same of gain times rigid torque, and an offset"));
    a->Field("inertials", &inertials,
             LeftOut("of the links from the base on, ten numbers each (kg, kg.m, kg.m^2), as the "
                     "joint's torque shows them"));
  }
};

/// A joint along its log, filtered, for pictures. All [N], torques in the log's unit.
struct JointSeries {
  Eigen::VectorXd time;                        // s
  Eigen::VectorXd velocity;                    // rad/s or m/s
  Eigen::VectorXd measured;                    // torque less all that is not friction
  Eigen::VectorXd fitted;                      // friction
  Eigen::VectorXd energy;                      // E; empty where nothing warms
  Eigen::Array<bool, Eigen::Dynamic, 1> kept;  // away from rests and reversals
};

/// A joint of a robot.
struct RobotJointEstimate {
  RobotJointSummary summary;
  Estimate estimate;
  std::optional<JointSeries> series{};  // of a fit; not in files

  /// The friction in N.m or N that simulations use; nothing where none is known, or only in amperes.
  bool HasFriction() const { return estimate.friction && estimate.friction->torque_unit.empty(); }
};

/// Gravity of a base that does not stand as the description says, m/s^2 in the description's axes.
struct BaseGravity {
  std::vector<double> value{}, std{};  // [3]

  template <class A>
  void Serialize(A* a) {
    a->Field("value", &value, {.unit = "m/s^2", .meaning = "in the axes of the description"});
    a->Field("std", &std, {.unit = "m/s^2"});
  }
};

/// The result of identify-robot.
struct RobotEstimate {
  std::string robot;                       // file of the description
  std::vector<std::string> log;            // files
  std::vector<RobotJointEstimate> joints;  // in the order of the log
  std::vector<std::string> notices;        // one sentence each
  /// Mass of the load at the last link that the description lacks, kg; where one is shown or asked for.
  std::optional<EstimatedParameter> payload{};
  std::optional<BaseGravity> gravity{};  // where the base does not stand as the description says
  bool gravity_taken_off = false;        // by a controller, before the torques were logged
  /// s by which all torques come after the positions; where the log shows one.
  std::optional<EstimatedParameter> delay{};

  /// The joint of that name, or nullptr.
  const RobotJointEstimate* Find(std::string_view joint) const;
};

/// {joints{NAME: an estimate}, summary{NAME: ...}, robot, log, notices[], payload and delay: null or {value, unit, std, interval95},
/// gravity: null or {value[3], std[3]}, gravity_taken_off}, and the inverse. Throws BadInput.
std::string RobotEstimateToJson(const RobotEstimate& robot,
                                const std::filesystem::path& target = {});
RobotEstimate ReadRobotEstimate(const std::filesystem::path& file);

}  // namespace warmjoint
