#include "tools/compensate/robot/external_torque.h"

#include <fmt/format.h>
#include <warmjoint/friction_model.h>
#include <warmjoint/robot_estimate.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "identification/uncertainty/tails.h"
#include "models/foundation/bad_input.h"
#include "models/friction/friction_json.h"
#include "tools/compensate/compensate_log.h"
#include "tools/robot/joint_data.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The condition of J W J^T beyond which a direction of the force is not told. why: its deviation is then a hundred
/// times that of the best one.
constexpr double kWorstCondition = 1e4;

/// The rigid torque of a joint's motor, in N.m or N of its log.
struct Rigid {
  VectorXd torque;   // [N] with inertia and the offset of its log
  VectorXd carried;  // [N] without, which loads the joint
};

/// The value of a parameter, 0 where there is none.
double ValueIn(const Estimate& estimate, const char* name) {
  const EstimatedParameter* const one = estimate.Find(name);
  return one && std::isfinite(one->value) ? one->value : 0;
}

/// N.m or N of a joint's friction for one of its log's unit: the gain of a current, 1 of a torque.
double ConstantOf(const RobotJointEstimate& known) {
  return known.summary.torque_unit == "A" ? std::abs(known.summary.gain.value_or(1)) : 1;
}

Rigid RigidOf(const RobotData& data, const RobotRows& rows, Index j,
              const RobotJointEstimate& known, std::vector<std::string>& notices) {
  const std::vector<double>& mended = known.summary.inertials;
  VectorXd parameters = rows.parameters;
  if (std::ssize(mended) == parameters.size()) {
    parameters = VectorXd::Map(mended.data(), std::ssize(mended));
  } else {
    notices.push_back(fmt::format(
        "{}: robot.json holds no inertials for this description, which is taken as it is; identify "
        "again with it",
        known.summary.joint));
  }
  const VectorXd weights = data.coupling.inverse().col(j);
  const RobotMotion& motion = rows.motions.front();
  // of a torque in amperes that friction in N.m was made of, the description's own
  const bool in_amperes = known.summary.torque_unit == "A";
  const double gain = in_amperes ? 1 : known.summary.gain.value_or(1);
  Rigid rigid;
  rigid.carried = gain * (motion.Regressor(weights, Accelerations::left_out) * parameters);
  rigid.torque = gain * (motion.Regressor(weights, Accelerations::counted) * parameters) +
                 ValueIn(known.estimate, "rotor_inertia") / ConstantOf(known) *
                     rows.samples.front().acceleration.col(j);
  rigid.torque.array() += ValueIn(known.estimate, kTorqueOffset) / ConstantOf(known);
  return rigid;
}

/// The deviation of a sample about the model, N.m or N: on unseen data where there is one.
double StdOfSample(const RobotJointEstimate& known) {
  const double fitted = known.estimate.metrics ? known.estimate.metrics->rmse : 0;
  return known.summary.rms_held_out.value_or(fitted) / ConstantOf(known);
}

JointExternal Along(const RobotData& data, const RobotRows& rows, Index j,
                    const RobotJointEstimate& known, const CompensatorSettings& compensation,
                    std::vector<std::string>& notices) {
  const RobotSamples& s = rows.samples.front();
  const Rigid rigid = RigidOf(data, rows, j, known, notices);
  JointExternal found{known.summary.joint,
                      data.robot.joints[static_cast<std::size_t>(j)].kind,
                      s.velocity.col(j),
                      s.torque.col(j) / ConstantOf(known),
                      rigid.torque,
                      {},
                      {},
                      {},
                      {},
                      {}};

  // friction where the joint clearly moves; elsewhere it is held, by anything up to its level
  const JointToCompensate joint = ToCompensate(known.estimate, known.summary.joint);
  FrictionDoubt doubt = joint.doubt;
  doubt.noise = StdOfSample(known);
  Compensator compensator(joint.stored.model.friction, doubt, compensation);
  const auto moves = s.keep.col(j);
  JointTrajectory motion{s.time, moves.select(s.velocity.col(j).array(), 0.0).matrix(),
                         s.position.col(j)};
  motion.load = rigid.carried;
  motion.torque = found.torque - rigid.torque;
  const Compensated compensated = CompensateAlong(compensator, motion);
  found.friction = compensated.friction;
  found.energy = compensated.energy;
  found.contact = compensated.contact;
  found.external = found.friction - motion.torque;

  // bands: of the level and of a sample; a uniform distribution of what holds
  const double level = FrictionModel(joint.stored.model.friction).HoldingLevel();
  found.half_width.resize(s.time.size());
  for (Index i = 0; i < s.time.size(); ++i) {
    const double held = std::max(0.0, level + compensated.energy[i]);
    const double of_friction = moves[i] ? compensated.std[i] : held / std::sqrt(3.0);
    found.half_width[i] = kNormal95 * std::hypot(of_friction, doubt.noise);
  }
  return found;
}

/// J of the tool's place at each sample, in order of the robot's joints; [3 x n]
class ToolJacobian {
 public:
  ToolJacobian(const RobotDescription& robot, const std::vector<double>& centre)
      : robot_(robot), data_(mj_makeData(robot.model.get())), centre_(centre) {}
  ~ToolJacobian() { mj_deleteData(data_); }
  ToolJacobian(const ToolJacobian&) = delete;
  ToolJacobian& operator=(const ToolJacobian&) = delete;

  /// q: [n] rad or m
  MatrixXd At(const VectorXd& q) const {
    const mjModel& m = *robot_.model;
    for (std::size_t k = 0; k < robot_.joints.size(); ++k) {
      data_->qpos[robot_.joints[k].qpos] = q[static_cast<Index>(k)];
    }
    mj_kinematics(&m, data_);
    mj_comPos(&m, data_);
    const int body = robot_.links[static_cast<std::size_t>(LastLink(robot_))].body;
    mjtNum point[3];
    mju_mulMatVec3(point, data_->xmat + 9 * body, centre_.data());
    mju_addTo3(point, data_->xpos + 3 * body);
    Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor> all(3, m.nv);
    mj_jac(&m, data_, all.data(), nullptr, point, body);
    MatrixXd mine(3, std::ssize(robot_.joints));
    for (std::size_t k = 0; k < robot_.joints.size(); ++k) {
      mine.col(static_cast<Index>(k)) = all.col(robot_.joints[k].dof);
    }
    return mine;
  }

 private:
  const RobotDescription& robot_;
  mjData* data_;
  std::vector<double> centre_;
};

/// The force at the tool of each sample with its band.
void FindForce(const RobotData& data, const RobotRows& rows, const RobotSettings& settings,
               const std::vector<Index>& of, RobotExternal& found) {
  const RobotSamples& s = rows.samples.front();
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  found.force = MatrixXd::Constant(s.time.size(), 3, none);
  found.force_half_width = found.force;
  const ToolJacobian jacobian(data.robot, settings.tool.centre);
  // motors that several joints turn: tau_q = C^T tau_m, so that tau_m = C^-T J^T f
  const MatrixXd to_motors = data.coupling.inverse();
  for (Index i = 0; i < s.time.size(); ++i) {
    const MatrixXd all = jacobian.At(s.joint_position.row(i).transpose()) * to_motors;
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < of.size(); ++k) {
      const JointExternal& one = found.joints[k];
      const double std = one.half_width[i] / kNormal95;
      const Eigen::Vector3d column = all.col(of[k]) / std;
      information += column * column.transpose();
      right += column * one.external[i] / std;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> parts(information);
    const Eigen::Vector3d& values = parts.eigenvalues();
    if (!(values[0] > values[2] / kWorstCondition)) continue;
    const Eigen::Matrix3d covariance = information.inverse();
    found.force.row(i) = (covariance * right).transpose();
    found.force_half_width.row(i) = kNormal95 * covariance.diagonal().cwiseSqrt().transpose();
  }
}

}  // namespace

RobotExternal FindExternal(const std::filesystem::path& robot, const RobotEstimate& estimate,
                           const RobotSource& source, RobotSettings settings,
                           const CompensatorSettings& compensation) {
  if (settings.gravity.empty() && estimate.gravity) settings.gravity = estimate.gravity->value;
  if (source.logs.size() != 1) Refuse({"log"}, "are {}; give one", source.logs.size());
  const RobotData data = ReadRobotData(robot, source, settings);
  const RobotRows rows = MakeRows(data, settings);
  RobotExternal found;
  found.notices = data.notices;
  found.time = rows.samples.front().time;

  // joints whose friction is known
  std::vector<Index> of;
  for (Index j = 0; j < std::ssize(data.robot.joints); ++j) {
    const std::string& name = data.robot.joints[static_cast<std::size_t>(j)].name;
    const RobotJointEstimate* const known = estimate.Find(name);
    if (!known || !known->HasFriction()) {
      found.notices.push_back(fmt::format("{} is left out: {}", name,
                                          known && known->estimate.friction
                                              ? "its friction is known in A alone"
                                              : "it has no friction"));
      continue;
    }
    of.push_back(j);
    found.joints.push_back(Along(data, rows, j, *known, compensation, found.notices));
  }
  if (of.empty()) Refuse({"robot"}, "holds no friction in N.m or N of any joint of the log");
  FindForce(data, rows, settings, of, found);
  return found;
}

FileContent ColumnsOf(const RobotExternal& found) {
  FileContent content;
  const auto add = [&](const std::string& name, std::string_view unit, const VectorXd& values) {
    content.columns.push_back({.name = name, .unit = std::string(unit), .values = values});
  };
  add("time", "s", found.time);
  for (const JointExternal& one : found.joints) {
    const std::string_view torque = kTorqueUnit.For(one.kind);
    add(one.joint + ".velocity", kVelocityUnit.For(one.kind), one.velocity);
    add(one.joint + ".torque", torque, one.torque);
    add(one.joint + ".rigid", torque, one.rigid);
    add(one.joint + ".friction", torque, one.friction);
    add(one.joint + ".energy", torque, one.energy);
    add(one.joint + ".external", torque, one.external);
    add(one.joint + ".half_width", torque, one.half_width);
    add(one.joint + ".contact", "", one.contact);
  }
  for (Index k = 0; k < 3; ++k) {
    const std::string axis(1, "xyz"[k]);
    add("force." + axis, "N", found.force.col(k));
    add("force_half_width." + axis, "N", found.force_half_width.col(k));
  }
  return content;
}

}  // namespace warmjoint
