// A robot as its rigid-body torque needs it: kinematics by MuJoCo, and the inertial parameters of what moves.
#pragma once

#include <mujoco/mujoco.h>
#include <warmjoint/friction.h>

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/model/spec_elements.h"

namespace warmjoint {

/// Mass (kg), mass times place of the centre (kg.m, 3), inertia about the origin (kg.m^2: xx yy zz xy xz yz), in the body's axes.
using InertialParameters = Eigen::Matrix<double, 10, 1>;

/// A hinge or slide of the robot.
struct ModelJoint {
  std::string name;
  JointKind kind = JointKind::rotary;
  int dof = 0, qpos = 0;                       // places in mjData
  std::optional<std::array<double, 2>> range;  // rad or m; none: unlimited
};

/// What moves as one body: a body with a joint that was logged, and all that is fixed to it.
struct RobotLink {
  int body = 0;  // of the model, whose axes count
  std::string name;
  InertialParameters parameters;
  /// What a relative error of 1 of mass, place of the mass and inertia makes of each parameter.
  InertialParameters spread;
};

struct RobotDescription {
  std::string name;                        // of the file, in messages
  std::shared_ptr<const mjModel> model{};  // in which nothing acts but gravity and inertia
  std::vector<ModelJoint> joints{};        // [n] in the order of the log
  std::vector<RobotLink> links{};          // from the base outwards
  std::vector<double> rest{};          // [nq] of the model, where joints that were not logged stand
  std::vector<std::string> notices{};  // what was mended or left out, one sentence each

  /// Whether the joint moves the link.
  bool Moves(const ModelJoint& joint, const RobotLink& link) const;
  /// The parameters of all links, one behind the other. [10 L]
  Eigen::VectorXd Parameters() const;
  Eigen::VectorXd Spreads() const;
};

/// A description that was read, of which nobody has said yet which joints were logged.
struct ReadModel {
  std::string name;
  ModelPtr model;
  std::vector<std::string> joints;  // names of all hinges and slides, from the base outwards
  std::vector<std::string> notices;
};

/// Reads an MJCF, a URDF (by urdfdom; handed on as an mjSpec) or a compiled model (.mjb). What MuJoCo would refuse is mended, with
/// a notice for each kind: inertias that are none of a body, moving links without mass, meshes that are not there. Damping,
/// friction loss, armature, springs and gravity compensation are taken out, with a notice. Throws BadInput.
ReadModel ReadRobotModel(const std::filesystem::path& file);

/// The robot whose `joints` were logged, in that order; the others stand still, those of `at` where that says (rad or m), the rest at 0, and what
/// they carry is merged with what carries them. Throws BadInput for a name that the model lacks, and for a logged joint in `at`.
RobotDescription DescribeRobot(ReadModel read, const std::vector<std::string>& joints,
                               const std::map<std::string, double>& at = {});

}  // namespace warmjoint
