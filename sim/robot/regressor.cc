#include "sim/robot/regressor.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <thread>

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using RowMatrix3d = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

/// x . (inertia p) for an inertia (xx yy zz xy xz yz): its row.
Vector6d InertiaRow(const Vector3d& x, const Vector3d& p) {
  Vector6d row;
  row << x[0] * p[0], x[1] * p[1], x[2] * p[2], x[0] * p[1] + x[1] * p[0],
      x[0] * p[2] + x[2] * p[0], x[1] * p[2] + x[2] * p[1];
  return row;
}

/// An axis (turn, shift) at the link's origin against the wrench that moves a body there: Newton and Euler about the origin,
/// force = m a + (al x + w x w x) m c, torque = I al + w x I w - a x m c. w, al: rad/s, rad/s^2; a: of the origin less gravity, m/s^2.
InertialParameters PowerRow(const Vector3d& turn, const Vector3d& shift, const Vector3d& w,
                            const Vector3d& al, const Vector3d& a) {
  InertialParameters row;
  row[0] = shift.dot(a);
  row.segment<3>(1) = a.cross(turn) + shift.cross(al) + shift.cross(w).cross(w);
  row.segment<6>(4) = InertiaRow(turn, al) + InertiaRow(turn.cross(w), w);
  return row;
}

Eigen::Map<const Vector3d> At(const double* p) { return Eigen::Map<const Vector3d>(p); }

}  // namespace

RobotMotion::RobotMotion(const RobotDescription& robot, const Eigen::MatrixXd& q,
                         const Eigen::MatrixXd& v, const Eigen::MatrixXd& a)
    : robot_(robot),
      samples_(q.rows()),
      links_(kOfLink * std::ssize(robot.links), q.rows()),
      joints_(6 * std::ssize(robot.joints), q.rows()) {
  const mjModel& m = *robot.model;
  const auto run = [&](Index first, Index last) {
    const DataPtr data(mj_makeData(&m));
    mjData& d = *data;
    std::ranges::copy(robot.rest, d.qpos);
    for (Index i = first; i < last; ++i) {
      const auto set = [&](mjtNum* values, const Eigen::MatrixXd& given, auto place) {
        for (std::size_t j = 0; j < robot.joints.size(); ++j) {
          values[robot.joints[j].*place] = given(i, static_cast<Index>(j));
        }
      };
      set(d.qpos, q, &ModelJoint::qpos);
      set(d.qvel, v, &ModelJoint::dof);
      mju_zero(d.qacc, static_cast<int>(m.nv));
      mj_kinematics(&m, &d);
      mj_comPos(&m, &d);
      mj_comVel(&m, &d);
      mj_rnePostConstraint(&m, &d);
      Record(m, d, i, Accelerations::left_out);
      set(d.qacc, a, &ModelJoint::dof);
      mj_rnePostConstraint(&m, &d);
      Record(m, d, i, Accelerations::counted);
    }
  };
  // samples do not know of each other
  const auto threads = static_cast<Index>(std::clamp(std::thread::hardware_concurrency(), 1U, 8U));
  std::vector<std::jthread> others;
  const Index share = samples_ / threads + 1;
  for (Index first = share; first < samples_; first += share) {
    others.emplace_back(run, first, std::min(first + share, samples_));
  }
  run(0, std::min(share, samples_));
}

void RobotMotion::Record(const mjModel& m, const mjData& d, Index sample, Accelerations which) {
  const bool counted = which == Accelerations::counted;
  for (std::size_t k = 0; k < robot_.links.size(); ++k) {
    const int body = robot_.links[k].body;
    double* const row = &links_(kOfLink * static_cast<Index>(k), sample);
    const RowMatrix3d axes = Eigen::Map<const RowMatrix3d>(d.xmat + 9 * body);
    // MuJoCo's spatial vectors are about the centre of mass of the tree, in the world's axes
    const Vector3d from = At(d.xpos + 3 * body) - At(d.subtree_com + 3 * m.body_rootid[body]);
    const auto local = [&](const mjtNum* spatial, Vector3d& turn, Vector3d& shift) {
      turn = axes.transpose() * At(spatial);
      shift = axes.transpose() * (At(spatial + 3) + At(spatial).cross(from));
    };
    Vector3d w, u, al, ac;
    local(d.cvel + 6 * body, w, u);
    local(d.cacc + 6 * body, al, ac);
    ac += w.cross(u);  // of the origin itself, in place of the spatial one
    if (!counted) {
      Eigen::Map<RowMatrix3d>(row, 3, 3) = axes;
      Eigen::Map<Vector3d>(row + 9, 3) = from;
      Eigen::Map<Vector3d>(row + 12, 3) = w;
    }
    Eigen::Map<Vector3d>(row + (counted ? 15 : 21), 3) = al;
    Eigen::Map<Vector3d>(row + (counted ? 18 : 24), 3) = ac;
  }
  for (std::size_t j = 0; j < robot_.joints.size() && counted; ++j) {
    joints_.block<6, 1>(6 * static_cast<Index>(j), sample) =
        Eigen::Map<const Vector6d>(d.cdof + 6 * robot_.joints[j].dof);
  }
}

/// row: of a link by its numbers, its axes, and the turn and shift of the joints' axes there
template <typename Row>
Eigen::MatrixXd RobotMotion::RowsOf(const Eigen::VectorXd& weights, const Row& row_of) const {
  const Index l = std::ssize(robot_.links);
  Eigen::MatrixXd regressor = Eigen::MatrixXd::Zero(samples_, 10 * l);
  for (Index k = 0; k < l; ++k) {
    // the joints that move this link
    std::vector<Index> movers;
    for (Index j = 0; j < weights.size(); ++j) {
      const bool moves = robot_.Moves(robot_.joints[static_cast<std::size_t>(j)],
                                      robot_.links[static_cast<std::size_t>(k)]);
      if (weights[j] != 0 && moves) movers.push_back(j);
    }
    if (movers.empty()) continue;
    for (Index i = 0; i < samples_; ++i) {
      const double* const row = &links_(kOfLink * k, i);
      const Eigen::Map<const RowMatrix3d> axes(row);
      Vector6d axis = Vector6d::Zero();
      for (const Index j : movers) axis += weights[j] * joints_.block<6, 1>(6 * j, i);
      const Vector3d turn = axes.transpose() * axis.head<3>();
      const Vector3d shift =
          axes.transpose() * (axis.tail<3>() + Vector3d(axis.head<3>()).cross(At(row + 9)));
      regressor.block<1, 10>(i, 10 * k) = row_of(row, axes, turn, shift).transpose();
    }
  }
  return regressor;
}

Eigen::MatrixXd RobotMotion::Regressor(const Eigen::VectorXd& weights, Accelerations which) const {
  const bool counted = which == Accelerations::counted;
  return RowsOf(weights,
                [&](const double* row, const auto&, const Vector3d& turn, const Vector3d& shift) {
                  return PowerRow(turn, shift, At(row + 12), At(row + (counted ? 15 : 21)),
                                  At(row + (counted ? 18 : 24)));
                });
}

Eigen::MatrixXd RobotMotion::GravityRegressor(const Eigen::VectorXd& weights,
                                              const Vector3d& gravity) const {
  return RowsOf(
      weights, [&](const double*, const auto& axes, const Vector3d& turn, const Vector3d& shift) {
        const Vector3d still = Vector3d::Zero();
        return PowerRow(turn, shift, still, still, Vector3d(-(axes.transpose() * gravity)));
      });
}

Eigen::MatrixXd RobotMotion::Regressor(Index joint, Accelerations which) const {
  return Regressor(Eigen::VectorXd::Unit(std::ssize(robot_.joints), joint), which);
}

PriorDirections DirectionsSeen(const Eigen::MatrixXd& regressor,
                               const Eigen::VectorXd& deviations) {
  const Eigen::MatrixXd scaled = regressor * deviations.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled.transpose() * scaled);
  const Eigen::VectorXd& squares = solver.eigenvalues();  // ascending
  constexpr double unseen = 1e-9;  // why: below the rounding of some 1e5 squares' sum, to the root
  const Index count = (squares.array() > unseen * squares.tail(1)[0]).count();
  return {deviations.asDiagonal() * solver.eigenvectors().rightCols(count)};
}

}  // namespace warmjoint
