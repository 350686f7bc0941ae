#include "tools/robot/joint_data.h"

#include <Eigen/LU>
#include <algorithm>

#include "sim/robot/regressor.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Rows of all logs, one behind the other. part: of one log, [N x m]
template <typename Part>
MatrixXd Stacked(const RobotRows& rows, const Part& part) {
  std::vector<MatrixXd> parts;
  Index count = 0;
  for (std::size_t i = 0; i < rows.samples.size(); ++i) {
    parts.push_back(part(i));
    count += parts.back().rows();
  }
  if (parts.size() == 1) return std::move(parts.front());
  MatrixXd all(count, parts.front().cols());
  Index at = 0;
  for (const MatrixXd& one : parts) {
    all.middleRows(at, one.rows()) = one;
    at += one.rows();
  }
  return all;
}

/// Parameters of a point mass at the last link. kg, m
InertialParameters PointMass(double mass, const std::vector<double>& at) {
  const Eigen::Vector3d c(at[0], at[1], at[2]);
  const Eigen::Matrix3d inertia =
      mass * (c.squaredNorm() * Eigen::Matrix3d::Identity() - c * c.transpose());
  InertialParameters p;
  p << mass, mass * c, inertia(0, 0), inertia(1, 1), inertia(2, 2), inertia(0, 1), inertia(0, 2),
      inertia(1, 2);
  return p;
}

/// The prior of a description that is wrong by a factor of e in mass, place of the mass and inertia. A link of another mass, equal in shape, has all ten
/// parameters in proportion.
MatrixXd SpreadOf(const RobotDescription& robot) {
  MatrixXd spread = robot.Spreads().asDiagonal();
  for (Index at = 0; const RobotLink& link : robot.links) {
    spread.block<10, 1>(at, at) +=
        link.parameters - Eigen::Matrix<double, 10, 1>::Unit(0) * link.parameters[0];
    at += 10;
  }
  return spread;
}

}  // namespace

Index LastLink(const RobotDescription& robot) {
  Index last = 0;
  std::ptrdiff_t most = 0;
  for (Index k = 0; k < std::ssize(robot.links); ++k) {
    const auto movers = std::ranges::count_if(robot.joints, [&](const ModelJoint& joint) {
      return robot.Moves(joint, robot.links[static_cast<std::size_t>(k)]);
    });
    if (movers >= most) last = k, most = movers;
  }
  return last;
}

RobotRows MakeRows(const RobotData& data, const RobotSettings& settings) {
  RobotRows rows;
  const Index n = std::ssize(data.robot.joints);
  VectorXd gears(n);
  for (Index j = 0; j < n; ++j) {
    gears[j] = NumberOf(settings.gear, data.robot.joints[static_cast<std::size_t>(j)].name, 0);
  }
  for (const RobotLog& log : data.logs) {
    rows.samples.push_back(PrepareRobot({log.step, log.time, log.position, log.torque, log.logged},
                                        data.coupling, gears, {.cutoff = settings.cutoff}));
    const RobotSamples& s = rows.samples.back();
    rows.motions.emplace_back(data.robot, s.joint_position, s.joint_velocity, s.joint_acceleration);
  }
  const Eigen::Vector3d gravity = Eigen::Map<const Eigen::Vector3d>(data.robot.model->opt.gravity);
  rows.gravity = {gravity, gravity, gravity, MatrixXd(3, 0)};
  rows.parameters = data.robot.Parameters();
  rows.deviations = settings.inertials * SpreadOf(data.robot);
  if (settings.tool.known == ToolKnown::given) {
    rows.parameters.segment<10>(10 * LastLink(data.robot)) +=
        PointMass(settings.tool.mass, settings.tool.centre);
  }
  return rows;
}

RobotRows Thinned(const RobotData& data, const RobotRows& rows, Index most) {
  RobotRows thinned;
  thinned.gravity = rows.gravity;
  thinned.parameters = rows.parameters;
  thinned.deviations = rows.deviations;
  for (const RobotSamples& s : rows.samples) {
    const Index every = std::max<Index>(1, s.time.size() / most);
    const auto thin = Eigen::seq(0, s.time.size() - 1, every);
    RobotSamples t;
    t.step = s.step * static_cast<double>(every);
    t.time = s.time(thin);
    for (const auto column :
         {&RobotSamples::joint_position, &RobotSamples::joint_velocity,
          &RobotSamples::joint_acceleration, &RobotSamples::position, &RobotSamples::velocity,
          &RobotSamples::acceleration, &RobotSamples::torque, &RobotSamples::sign,
          &RobotSamples::forwards, &RobotSamples::backwards, &RobotSamples::slow}) {
      t.*column = (s.*column)(thin, Eigen::all);
    }
    t.keep = s.keep(thin, Eigen::all);
    t.top = s.top;
    t.travel = s.travel;
    t.ripple.assign(s.ripple.size(), MatrixXd(t.time.size(), 0));
    thinned.motions.emplace_back(data.robot, t.joint_position, t.joint_velocity,
                                 t.joint_acceleration);
    thinned.samples.push_back(std::move(t));
  }
  return thinned;
}

MatrixXd GravityColumns(const RobotData& data, const RobotRows& rows, Index j) {
  const VectorXd weights = data.coupling.inverse().col(j);
  return Stacked(rows, [&](std::size_t i) -> MatrixXd {
    MatrixXd columns(rows.motions[i].size(), 3);
    for (const Index axis : {0, 1, 2}) {
      columns.col(axis) =
          rows.motions[i].GravityRegressor(weights, Eigen::Vector3d::Unit(axis)) * rows.parameters;
    }
    return columns;
  });
}

JointColumns ColumnsOf(const RobotData& data, const RobotRows& rows, Index j,
                       Directions directions) {
  const auto joint = static_cast<std::size_t>(j);
  JointColumns c;
  c.joint = data.robot.joints[joint].name;
  c.kind = data.robot.joints[joint].kind;
  c.torque_unit = data.torque_units[joint];
  c.step = rows.samples.front().step;
  const auto column = [&](MatrixXd RobotSamples::*of) -> VectorXd {
    return Stacked(rows, [&](std::size_t i) -> MatrixXd { return (rows.samples[i].*of).col(j); });
  };
  c.position = column(&RobotSamples::position);
  c.velocity = column(&RobotSamples::velocity);
  c.acceleration = column(&RobotSamples::acceleration);
  c.sign = column(&RobotSamples::sign);
  c.forwards = column(&RobotSamples::forwards);
  c.backwards = column(&RobotSamples::backwards);
  constexpr Index shares = std::ssize(kSlowShares);
  c.slow = Stacked(rows, [&](std::size_t i) -> MatrixXd {
    return rows.samples[i].slow.middleCols(shares * j, shares);
  });
  c.ripple = Stacked(rows, [&](std::size_t i) { return rows.samples[i].ripple[joint]; });
  c.samples.torque = column(&RobotSamples::torque);

  // time goes on from log to log, a step apart
  const Index count = c.velocity.size();
  c.samples.time.resize(count);
  c.samples.keep.resize(count);
  Index at = 0;
  double begin = 0;
  for (const RobotSamples& s : rows.samples) {
    const Index size = s.time.size();
    c.samples.time.segment(at, size) = s.time.array() - s.time[0] + begin;
    c.samples.keep.segment(at, size) = s.keep.col(j);
    c.top_speed = std::max(c.top_speed, s.top[j]);
    if (at > 0) c.samples.starts.push_back(at);
    at += size;
    begin = c.samples.time[at - 1] + c.step;
  }

  // torque of the motor, of the joints that it drives, by the description and by what that may have wrong
  const VectorXd weights = data.coupling.inverse().col(j);
  const auto regressor = [&](Accelerations which, const Eigen::Vector3d& gravity) {
    const Eigen::Vector3d change = gravity - rows.gravity.described;
    return Stacked(rows, [&](std::size_t i) -> MatrixXd {
      MatrixXd of_log = rows.motions[i].Regressor(weights, which);
      if (!change.isZero(0)) of_log += rows.motions[i].GravityRegressor(weights, change);
      return of_log;
    });
  };
  const MatrixXd y = regressor(Accelerations::counted, rows.gravity.in_torque),
                 still = regressor(Accelerations::left_out, rows.gravity.at_joints);
  MatrixXd basis = rows.deviations;
  if (directions == Directions::seen) {
    basis *= DirectionsSeen(y * basis, VectorXd::Ones(basis.cols())).basis;
  }
  c.rigid = {y * rows.parameters, y * basis};
  c.carried = {still * rows.parameters, still * basis};
  if (rows.gravity.open.cols() > 0) {
    // what is not known of gravity, for all joints the same
    const MatrixXd open = GravityColumns(data, rows, j) * rows.gravity.open;
    c.AddDirections(open, open);
  }
  c.described = rows.parameters;
  c.basis = std::move(basis);
  return c;
}

}  // namespace warmjoint
