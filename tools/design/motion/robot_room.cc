#include "tools/design/motion/robot_room.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "models/foundation/bad_input.h"
#include "models/foundation/description_text.h"
#include "models/foundation/names.h"
#include "models/foundation/random_stream.h"
#include "models/foundation/xml_tags.h"
#include "models/robots/robot_folder.h"
#include "sim/model/load_model.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::string BodyName(const mjModel& m, int body) {
  const char* const name = mj_id2name(&m, mjOBJ_BODY, body);
  return name && *name ? std::string(name) : fmt::format("body {}", body);
}

/// The range of an actuator's force, N.m or N at its transmission; none where it is not limited.
std::optional<double> ForceOf(const mjModel& m, int actuator) {
  const auto least = [](const mjtNum* range) { return std::min(-range[0], range[1]); };
  if (m.actuator_forcelimited[actuator]) return least(m.actuator_forcerange + 2 * actuator);
  const bool plain = m.actuator_gaintype[actuator] == mjGAIN_FIXED &&
                     m.actuator_biastype[actuator] == mjBIAS_NONE &&
                     m.actuator_dyntype[actuator] == mjDYN_NONE;
  if (!plain || !m.actuator_ctrllimited[actuator]) return std::nullopt;
  const double gain = m.actuator_gainprm[mjNGAIN * actuator];
  return std::abs(gain) * least(m.actuator_ctrlrange + 2 * actuator);
}

/// Positions by chance within limits.
VectorXd Anywhere(const Eigen::MatrixX2d& limits, RandomStream& random) {
  return VectorXd::NullaryExpr(limits.rows(),
                               [&](Index i) { return random.Uniform(limits(i, 0), limits(i, 1)); });
}

constexpr int kPoses =
    200;  // why: a pair that is free in one pose of a hundred is found in 87 % of tries

}  // namespace

RobotRoom::RobotRoom(const std::filesystem::path& file, const std::vector<std::string>& patterns,
                     const std::map<std::string, double>& at, double clearance)
    : name_(file.string()), clearance_(clearance), at_(at) {
  if (!(clearance >= 0 && clearance <= 1)) {
    Refuse({"--clearance"}, "is {:g} m; it must be from 0 to 1", clearance);
  }
  const Place place{name_};
  ParsedModel parsed = ParseModel(file);
  notices_ = std::move(parsed.notices);
  std::vector<std::string> names;
  for (const std::string& pattern : patterns) {
    for (const std::string& name : MatchJoints(*parsed.spec, pattern, place)) {
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
  }
  for (const auto& [name, value] : at) FindJoint(*parsed.spec, name, {"--at"});
  model_ = CompileModel(*parsed.spec, place);
  // what links do to each other is looked for, and torques are those of bodies and of the friction that is expected
  model_->opt.disableflags &= ~(mjDSBL_CONSTRAINT | mjDSBL_CONTACT);
  std::fill_n(model_->geom_gap, model_->ngeom, 0);
  data_.reset(mj_makeData(model_.get()));
  rest_.assign(data_->qpos, data_->qpos + model_->nq);
  TakeJoints(file, names);
  TakeTorques();
}

void RobotRoom::TakeJoints(const std::filesystem::path& file,
                           const std::vector<std::string>& names) {
  const mjModel& m = *model_;
  for (int id = 0; id < m.njnt; ++id) {
    const char* const name = mj_id2name(&m, mjOBJ_JOINT, id);
    const auto at = at_.find(name ? name : "");
    if (at != at_.end()) rest_[static_cast<size_t>(m.jnt_qposadr[id])] = at->second;
    if (!name || std::ranges::find(names, name) == names.end()) continue;
    RoomJoint& joint = joints_.emplace_back();
    joint.name = name;
    joint.kind = m.jnt_type[id] == mjJNT_SLIDE ? JointKind::linear : JointKind::rotary;
    if (m.jnt_limited[id]) joint.position = {m.jnt_range[2 * id], m.jnt_range[2 * id + 1]};
    ids_.push_back(id);
    // what hangs on it
    std::vector<bool>& moves = moves_.emplace_back(static_cast<size_t>(m.nbody), false);
    for (int body = 1; body < m.nbody; ++body) {
      moves[static_cast<size_t>(body)] =
          body == m.jnt_bodyid[id] || moves[static_cast<size_t>(m.body_parentid[body])];
    }
  }
  // MuJoCo does not keep the velocities of a URDF
  if (!IsUrdf(ReadDescription(file).text)) return;
  const urdf::ModelInterfaceSharedPtr robot = ReadUrdf(file);
  for (RoomJoint& joint : joints_) {
    const auto found = robot->joints_.find(joint.name);
    if (found == robot->joints_.end() || !found->second->limits) continue;
    const double velocity = found->second->limits->velocity;
    if (velocity > 0 && std::isfinite(velocity)) joint.velocity = velocity;
  }
}

void RobotRoom::TakeTorques() {
  const mjModel& m = *model_;
  for (size_t j = 0; j < joints_.size(); ++j) {
    const int id = ids_[j];
    // of all motors of the joint, if each has one
    std::optional<double> motors;
    for (int i = 0; i < m.nu; ++i) {
      if (m.actuator_trntype[i] != mjTRN_JOINT || m.actuator_trnid[2 * i] != id) continue;
      const auto force = ForceOf(m, i);
      const double one = force ? *force * std::abs(m.actuator_gear[6 * i]) : kInfinity;
      motors = motors.value_or(0) + one;
    }
    double most = motors.value_or(kInfinity);
    if (m.jnt_actfrclimited[id]) {
      most = std::min({most, -m.jnt_actfrcrange[2 * id], m.jnt_actfrcrange[2 * id + 1]});
    }
    // files say 0 where they know none
    if (most > 0 && std::isfinite(most)) joints_[j].torque = most;
  }
}

void RobotRoom::Pose(const VectorXd& position) {
  std::ranges::copy(rest_, data_->qpos);
  for (size_t j = 0; j < ids_.size(); ++j) {
    data_->qpos[model_->jnt_qposadr[ids_[j]]] = position[static_cast<Index>(j)];
  }
  mj_kinematics(model_.get(), data_.get());
  mj_comPos(model_.get(), data_.get());
}

double RobotRoom::Reach(size_t joint) const {
  const mjModel& m = *model_;
  const int id = ids_[joint];
  if (m.jnt_type[id] == mjJNT_SLIDE) return 1;
  const Eigen::Map<const Eigen::Vector3d> anchor(data_->xanchor + 3 * id);
  double reach = 0;
  for (int geom = 0; geom < m.ngeom; ++geom) {
    if (!moves_[joint][static_cast<size_t>(m.geom_bodyid[geom])]) continue;
    const Eigen::Map<const Eigen::Vector3d> middle(data_->geom_xpos + 3 * geom);
    reach = std::max(reach, (middle - anchor).norm() + m.geom_rbound[geom]);
  }
  return reach;
}

std::vector<size_t> RobotRoom::Between(int body, int other) const {
  std::vector<size_t> between;
  for (size_t j = 0; j < moves_.size(); ++j) {
    if (moves_[j][static_cast<size_t>(body)] != moves_[j][static_cast<size_t>(other)])
      between.push_back(j);
  }
  return between;
}

std::optional<Breach> RobotRoom::LookForContact(const RobotMoment& moment, double step) {
  const mjModel& m = *model_;
  // how far what a joint moves comes until the next look
  VectorXd comes(std::ssize(joints_));
  for (size_t j = 0; j < joints_.size(); ++j) {
    const auto i = static_cast<Index>(j);
    comes[i] =
        step / 2 * (std::abs(moment.velocity[i]) + step / 2 * std::abs(moment.acceleration[i]));
    if (comes[i] > 0) comes[i] *= Reach(j);
  }
  std::fill_n(model_->geom_margin, m.ngeom, clearance_ + comes.sum());
  mj_collision(model_.get(), data_.get());
  for (int i = 0; i < data_->ncon; ++i) {
    const mjContact& contact = data_->contact[i];
    const int a = m.body_weldid[m.geom_bodyid[contact.geom[0]]];
    const int b = m.body_weldid[m.geom_bodyid[contact.geom[1]]];
    if (overlaps_.contains(std::minmax(a, b))) continue;
    const std::vector<size_t> between = Between(a, b);
    double need = clearance_;
    for (const size_t j : between) need += comes[static_cast<Index>(j)];
    if (between.empty() || contact.dist >= need) continue;
    return Breach{fmt::format("'{}' comes as near as {:.3g} m to '{}'", BodyName(m, a),
                              contact.dist, BodyName(m, b)),
                  between};
  }
  return std::nullopt;
}

std::optional<Breach> RobotRoom::LookForTorque(const RobotMoment& moment) {
  const mjModel& m = *model_;
  std::fill_n(data_->qvel, m.nv, 0);
  std::fill_n(data_->qacc, m.nv, 0);
  for (size_t j = 0; j < ids_.size(); ++j) {
    data_->qvel[m.jnt_dofadr[ids_[j]]] = moment.velocity[static_cast<Index>(j)];
    data_->qacc[m.jnt_dofadr[ids_[j]]] = moment.acceleration[static_cast<Index>(j)];
  }
  mj_comVel(&m, data_.get());
  VectorXd torque(m.nv);
  mj_rne(&m, data_.get(), 1, torque.data());
  for (size_t j = 0; j < ids_.size(); ++j) {
    const int dof = m.jnt_dofadr[ids_[j]];
    const double takes = torque[dof] + m.dof_armature[dof] * data_->qacc[dof] +
                         moment.friction[static_cast<Index>(j)];
    if (std::abs(takes) <= joints_[j].torque.value_or(kInfinity)) continue;
    // the nearest to the cause first
    Breach breach{
        fmt::format("joint '{}' takes {:.4g} {}, beyond its {:g}", joints_[j].name, std::abs(takes),
                    kTorqueUnit.For(joints_[j].kind), *joints_[j].torque),
        {j}};
    for (size_t k = 0; k < ids_.size(); ++k) {
      if (k != j) breach.joints.push_back(k);
    }
    return breach;
  }
  return std::nullopt;
}

std::optional<Breach> RobotRoom::Look(const RobotMoment& moment, double step) {
  Pose(moment.position);
  if (auto breach = LookForContact(moment, step)) return breach;
  return LookForTorque(moment);
}

void RobotRoom::LeaveOutOverlaps(const Eigen::MatrixX2d& limits) {
  // pairs that touch in nearly every pose
  RandomStream random({1, 0}, Stream::start);
  std::map<std::pair<int, int>, int> touched;
  for (int pose = 0; pose < kPoses; ++pose) {
    Pose(Anywhere(limits, random));
    std::fill_n(model_->geom_margin, model_->ngeom, clearance_);
    mj_collision(model_.get(), data_.get());
    std::set<std::pair<int, int>> pairs;
    for (int i = 0; i < data_->ncon; ++i) {
      const int a = model_->body_weldid[model_->geom_bodyid[data_->contact[i].geom[0]]];
      const int b = model_->body_weldid[model_->geom_bodyid[data_->contact[i].geom[1]]];
      if (!Between(a, b).empty()) pairs.insert(std::minmax(a, b));
    }
    for (const auto& pair : pairs) ++touched[pair];
  }
  std::vector<std::string> names;
  for (const auto& [pair, times] : touched) {
    // why: the engine misses contacts of plane faces in a pose of some hundred; a pair that is free in a twentieth leaves no room for a motion
    if (times < kPoses * 19 / 20) continue;
    overlaps_.insert(pair);
    names.push_back(
        fmt::format("{} and {}", BodyName(*model_, pair.first), BodyName(*model_, pair.second)));
  }
  if (!names.empty()) {
    notices_.push_back(
        fmt::format("links that touch in every pose, or nearly so, are not kept apart: {}",
                    fmt::join(names, "; ")));
  }
  const bool shapes = std::any_of(model_->geom_contype, model_->geom_contype + model_->ngeom,
                                  [](int type) { return type != 0; });
  if (!shapes) {
    notices_.emplace_back(
        "the robot's file has no shapes that collide: links are not kept apart; look at the motion "
        "before the robot carries it out");
  }
}

VectorXd RobotRoom::Begin(const Eigen::MatrixX2d& limits) {
  LeaveOutOverlaps(limits);
  const mjModel& m = *model_;
  // where `at` says nothing: the middle, the reference, keyframes, anywhere
  const auto of = [&](const mjtNum* qpos) {
    return VectorXd::NullaryExpr(limits.rows(),
                                 [&](Index i) {
                                   const int id = ids_[static_cast<size_t>(i)];
                                   return std::clamp(qpos[m.jnt_qposadr[id]], limits(i, 0),
                                                     limits(i, 1));
                                 })
        .eval();
  };
  std::vector<VectorXd> places{limits.rowwise().mean(), of(m.qpos0)};
  for (int key = 0; key < m.nkey; ++key) places.push_back(of(m.key_qpos + key * m.nq));
  RandomStream random({2, 0}, Stream::start);
  for (int pose = 0; pose < kPoses; ++pose) places.push_back(Anywhere(limits, random));

  const auto none = VectorXd::Zero(limits.rows());
  std::string first;
  for (VectorXd& place : places) {
    for (size_t j = 0; j < joints_.size(); ++j) {
      const auto at = at_.find(joints_[j].name);
      if (at != at_.end()) place[static_cast<Index>(j)] = at->second;
    }
    const auto breach = Look({place, none, none, none}, 0);
    if (!breach) return place;
    if (first.empty()) first = breach->words;
  }
  Refuse({name_},
         "no place was found where the motion may begin: {}; give one by --at JOINT=RAD, lower "
         "--clearance, or <exclude> links in the model that never collide",
         first);
}

VectorXd RobotRoom::Gravity() {
  std::fill_n(data_->qvel, model_->nv, 0);
  mj_comVel(model_.get(), data_.get());
  VectorXd torque(model_->nv), of_joints(std::ssize(ids_));
  mj_rne(model_.get(), data_.get(), 0, torque.data());
  for (size_t j = 0; j < ids_.size(); ++j) {
    of_joints[static_cast<Index>(j)] = torque[model_->jnt_dofadr[ids_[j]]];
  }
  return of_joints;
}

/// Torques by the acceleration of one joint alone, where it stands. [n]
VectorXd RobotRoom::Inertial(Index joint, double acceleration) {
  const VectorXd gravity = Gravity();
  std::fill_n(data_->qacc, model_->nv, 0);
  data_->qacc[model_->jnt_dofadr[ids_[static_cast<size_t>(joint)]]] = acceleration;
  VectorXd torque(model_->nv), of_joints(std::ssize(ids_));
  mj_rne(model_.get(), data_.get(), 1, torque.data());
  for (Index i = 0; i < of_joints.size(); ++i) {
    const int dof = model_->jnt_dofadr[ids_[static_cast<size_t>(i)]];
    of_joints[i] = torque[dof] + model_->dof_armature[dof] * data_->qacc[dof] - gravity[i];
  }
  return of_joints;
}

double RobotRoom::Acceleration(size_t joint, const Eigen::MatrixX2d& limits, double friction) {
  if (!joints_[joint].torque) return kInfinity;
  const auto i = static_cast<Index>(joint);
  RandomStream random({3, 0}, Stream::start);
  std::vector<double> left;
  for (int pose = 0; pose < kPoses; ++pose) {
    Pose(Anywhere(limits, random));
    const double torque = *joints_[joint].torque - friction - std::abs(Gravity()[i]);
    left.push_back(torque / Inertial(i, 1)[i]);
  }
  std::ranges::nth_element(left, left.begin() + kPoses / 2);
  return left[kPoses / 2] / 2;
}

MatrixXd RobotRoom::Coupling(const VectorXd& position, const VectorXd& other,
                             const VectorXd& acceleration) {
  const auto n = std::ssize(ids_);
  MatrixXd coupling(n, n);
  // gravity with one joint elsewhere
  Pose(position);
  const VectorXd gravity = Gravity();
  for (Index j = 0; j < n; ++j) {
    VectorXd changed = position;
    changed[j] = other[j];
    Pose(changed);
    coupling.col(j) = (Gravity() - gravity).cwiseAbs();
  }
  Pose(position);
  for (Index j = 0; j < n; ++j) coupling.col(j) += Inertial(j, acceleration[j]).cwiseAbs();
  coupling.diagonal().setZero();
  return coupling;
}

}  // namespace warmjoint
