#include "tools/robot/find_faults.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "identification/model/normal_equations.h"
#include "identification/model/solve.h"
#include "sim/robot/regressor.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kMostSamples = 1500;  // why: six unknowns a joint are told by far fewer
constexpr double kFalls =
    2;  // a description that is wrong by a tenth leaves less between right and wrong columns
constexpr double kRises = 1.1;
constexpr Index kFewest = 60;

/// A thinned motion of all joints.
struct Motion {
  MatrixXd q, v, a, torque;  // [N x n]
  Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> keep;
};

Motion ThinnedOf(const RobotSamples& s) {
  const Index every = std::max<Index>(1, s.time.size() / kMostSamples);
  const auto thin = Eigen::seq(0, s.time.size() - 1, every);
  return {s.joint_position(thin, Eigen::all), s.joint_velocity(thin, Eigen::all),
          s.joint_acceleration(thin, Eigen::all), s.torque(thin, Eigen::all),
          s.keep(thin, Eigen::all)};
}

/// Rms that least squares of gain, offset, friction and rotor leaves of each joint; NaN of one that hardly moves. [n]
VectorXd Residuals(const RobotData& data, const VectorXd& parameters, const Motion& m) {
  const Index n = m.q.cols();
  const RobotMotion motion(data.robot, m.q, m.v, m.a);
  const MatrixXd speed = m.v * data.coupling.transpose(), rate = m.a * data.coupling.transpose();
  const MatrixXd inverse = data.coupling.inverse();
  VectorXd left = VectorXd::Constant(n, std::nan(""));
  for (Index j = 0; j < n; ++j) {
    const VectorXd rigid =
        motion.Regressor(VectorXd(inverse.col(j)), Accelerations::counted) * parameters;
    std::vector<Index> kept;
    for (Index i = 0; i < m.q.rows(); ++i) {
      if (m.keep(i, j)) kept.push_back(i);
    }
    if (std::ssize(kept) < kFewest) continue;
    MatrixXd columns(m.q.rows(), 5);
    columns << rigid, speed.col(j), (speed.col(j).array() > 0).cast<double>(),
        (speed.col(j).array() < 0).cast<double>(), rate.col(j);
    const MatrixXd x = columns(kept, Eigen::all);
    const VectorXd y = m.torque.col(j)(kept);
    const VectorXd e = y - x * SolveScaled(x.transpose() * x, x.transpose() * y);
    left[j] = std::sqrt(e.squaredNorm() / static_cast<double>(kept.size()));
  }
  return left;
}

/// A change that undoes a fault.
struct Undoing {
  std::string sentence;
  std::function<void(Motion&)> apply;
  Index first = 0, second = 0;  // joints whose columns it swaps
};

std::vector<Undoing> UndoingsOf(const RobotData& data, const NumberOfJoints& gears) {
  std::vector<Undoing> all;
  const auto& joints = data.robot.joints;
  const Index n = std::ssize(joints);
  const auto name = [&](Index j) { return joints[static_cast<std::size_t>(j)].name; };
  for (Index i = 0; i < n; ++i) {
    for (Index j = i + 1; j < n; ++j) {
      all.push_back(
          {fmt::format("the columns of {} and {} are swapped (--joints names the joints in "
                       "the order of the columns)",
                       name(i), name(j)),
           [i, j](Motion& m) {
             for (MatrixXd* one : {&m.q, &m.v, &m.a, &m.torque}) {
               one->col(i).swap(one->col(j));
             }
             m.keep.col(i).swap(m.keep.col(j));
           },
           i, j});
    }
  }
  const auto scaled = [](Index j, double factor) {
    return [j, factor](Motion& m) {
      for (MatrixXd* one : {&m.q, &m.v, &m.a}) one->col(j) *= factor;
    };
  };
  for (Index j = 0; j < n; ++j) {
    all.push_back(
        {fmt::format("the position of {} is turned (--scale {}.position=-1)", name(j), name(j)),
         scaled(j, -1), 0, 0});
    const double gear = NumberOf(gears, name(j), 0);
    if (gear == 0 || std::abs(gear) == 1) continue;
    all.push_back(
        {fmt::format("the position of {} is that of its motor (--scale {}.position={:.6g})",
                     name(j), name(j), 1 / gear),
         scaled(j, 1 / gear), 0, 0});
  }
  for (const auto& [words, factor] :
       {std::pair("positions are in degrees (--unit position=deg)", std::numbers::pi / 180),
        std::pair("positions are in rad (--unit position=rad)", 180 / std::numbers::pi)}) {
    all.push_back({words,
                   [n, factor = factor, scaled](Motion& m) {
                     for (Index j = 0; j < n; ++j) scaled(j, factor)(m);
                   },
                   0, 0});
  }
  return all;
}

}  // namespace

std::vector<RobotFault> FindFaults(const RobotData& data, const RobotRows& rows,
                                   const NumberOfJoints& gears) {
  const Motion given = ThinnedOf(rows.samples.front());
  const VectorXd before = Residuals(data, rows.parameters, given);
  std::optional<RobotFault> found;
  double best = 0;
  for (const Undoing& undoing : UndoingsOf(data, gears)) {
    Motion undone = given;
    undoing.apply(undone);
    VectorXd after = Residuals(data, rows.parameters, undone);
    // of the same columns as before
    std::swap(after[undoing.first], after[undoing.second]);
    RobotFault fault{undoing.sentence, {}};
    double gain = 0;
    bool rises = false;
    for (Index j = 0; j < before.size(); ++j) {
      if (!std::isfinite(before[j]) || !std::isfinite(after[j]) || !(after[j] > 0)) continue;
      const double falls = before[j] / after[j];
      gain += std::log(falls);
      rises = rises || falls * kRises < 1;
      if (falls >= kFalls) fault.joints.push_back(j);
    }
    if (fault.joints.empty() || rises || gain <= best) continue;
    best = gain;
    found = std::move(fault);
  }
  if (!found) return {};
  return {std::move(*found)};
}

}  // namespace warmjoint
