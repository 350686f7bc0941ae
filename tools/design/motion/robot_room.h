// A robot of which some joints move: what its file allows them, and what would break in a pose.
#pragma once

#include <warmjoint/friction.h>

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sim/model/spec_elements.h"

namespace warmjoint {

/// A joint that moves, with the limits of the robot's file.
struct RoomJoint {
  std::string name;
  JointKind kind = JointKind::rotary;
  std::optional<std::array<double, 2>> position{};  // rad or m
  std::optional<double> velocity{};                 // rad/s or m/s, of a URDF
  std::optional<double> torque{};                   // N.m or N, of its motors
};

/// The joints that move, at a time. [n] each
struct RobotMoment {
  Eigen::VectorXd position, velocity, acceleration;
  Eigen::VectorXd friction;  // torque that it takes, with the sign of the velocity
};

/// What must not be, and the joints of which one has to move otherwise.
struct Breach {
  std::string words;
  std::vector<size_t> joints;
};

class RobotRoom {
 public:
  /// file: MJCF or URDF; patterns: names of joints, or patterns of names; at: rad or m, where joints stand or begin; clearance: m.
  /// Throws BadInput.
  RobotRoom(const std::filesystem::path& file, const std::vector<std::string>& patterns,
            const std::map<std::string, double>& at, double clearance);

  const std::vector<RoomJoint>& joints() const { return joints_; }
  const std::vector<std::string>& notices() const { return notices_; }

  /// Where a motion within these limits (lower, upper; [n x 2]) begins with nothing broken: `at`; else in their middle, at the model's reference, at a
  /// keyframe, or anywhere. Links that touch in nearly every pose do not count, which notices say. Throws BadInput where there is no such place.
  Eigen::VectorXd Begin(const Eigen::MatrixX2d& limits);

  /// What a joint's torque leaves for its acceleration in the middle one of many poses, beside gravity and a friction; half of it, since others' ramps take
  /// some as well. rad/s^2 or m/s^2; infinite without a limit of the torque; 0 or less where nothing is left.
  double Acceleration(size_t joint, const Eigen::MatrixX2d& limits, double friction);

  /// The first thing that breaks: links nearer than the clearance, and as near as they may come half a `step` (s) before and after;
  /// a torque beyond its joint's limit.
  std::optional<Breach> Look(const RobotMoment& moment, double step);

  /// What of each joint's torque (rows) is due to each other joint: by its acceleration, and by its place against that in `other`. [n x n]
  Eigen::MatrixXd Coupling(const Eigen::VectorXd& position, const Eigen::VectorXd& other,
                           const Eigen::VectorXd& acceleration);

 private:
  void TakeJoints(const std::filesystem::path& file, const std::vector<std::string>& names);
  void TakeTorques();
  void Pose(const Eigen::VectorXd& position);
  std::optional<Breach> LookForContact(const RobotMoment& moment, double step);
  std::optional<Breach> LookForTorque(const RobotMoment& moment);
  void LeaveOutOverlaps(const Eigen::MatrixX2d& limits);
  /// How far from the joint what it moves reaches in this pose, m; 1 of a slide, which moves all alike.
  double Reach(size_t joint) const;
  /// The joints that move one of two bodies alone.
  std::vector<size_t> Between(int body, int other) const;
  Eigen::VectorXd Gravity();
  Eigen::VectorXd Inertial(Eigen::Index joint, double acceleration);

  std::string name_;
  ModelPtr model_;
  DataPtr data_;
  double clearance_;
  std::map<std::string, double> at_;
  std::vector<RoomJoint> joints_;
  std::vector<int> ids_;                  // [n] in the model
  std::vector<std::vector<bool>> moves_;  // [n][nbody]
  std::vector<double> rest_;              // [nq]
  std::set<std::pair<int, int>> overlaps_;
  std::vector<std::string> notices_;
};

}  // namespace warmjoint
