#include "tools/robot/find_gravity.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "identification/fit/fit_data.h"
#include "identification/model/normal_equations.h"
#include "identification/uncertainty/tails.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr Index kGravitySamples = 1500;  // why: nine unknowns a joint are told by far fewer
constexpr double kClearFall = 2;         // of the residual: as a fault of the log (FindFaults)
constexpr std::size_t kFewestFallen = 2;
/// Gravity's share in the torque below which a controller has taken it off: its own model of the masses is not wrong by more.
constexpr double kTakenOff = .2;
constexpr int kTriedDirections = 600;  // why: some 8 degrees from each to the next
constexpr double kTurnSpacing = .15;   // rad, of these
constexpr double kFinestTurn = 1e-5;   // rad

/// What one joint's torque says of gravity, after least squares of all that is not gravity.
struct Seen {
  MatrixXd
      columns;  // [N x 3] torque of gravity along each axis, for 1 m/s^2, less what the rest explains
  VectorXd torque;  // [N] less what the rest explains
  Matrix3d gram;
  Vector3d product;
  double squares = 0;
  bool is_torque = false;  // in N.m or N
  double scaled = 0;       // sum of squares that one gain of the whole rigid torque leaves

  /// Share s >= 0 of a gravity of unit direction u, m/s^2.
  double Share(const Vector3d& u) const {
    const double size = u.dot(gram * u);
    return size > 0 ? std::max(0.0, u.dot(product) / size) : 0;
  }
  /// Sum of squares that it leaves. Rounding of an exact torque leaves some.
  double Left(const Vector3d& u) const {
    const double s = Share(u);
    return std::max(squares - s * s * u.dot(gram * u), 1e-9 * squares) + 1e-300;
  }
  double Rms(double left) const { return std::sqrt(left / static_cast<double>(torque.size())); }
};

Seen SeenBy(const RobotData& data, const RobotRows& rows, Index j) {
  const JointColumns c = ColumnsOf(data, rows, j);
  const Selection used{c.samples.keep, {}};
  const MatrixXd by_gravity = GravityColumns(data, rows, j);
  MatrixXd rest(c.velocity.size(), 5);
  rest << c.rigid.force - by_gravity * rows.gravity.in_torque, c.velocity, c.forwards, -c.backwards,
      c.acceleration;
  const MatrixXd x = Kept(rest, used), z = Kept(by_gravity, used);
  const VectorXd y = Kept(c.samples.torque, used);
  const MatrixXd inverse = InverseScaled(GramOf(x));
  Seen seen;
  seen.is_torque = IsTorque(c);
  seen.columns = z - x * (inverse * (x.transpose() * z));
  seen.torque = y - x * (inverse * (x.transpose() * y));
  seen.gram = GramOf(seen.columns);
  seen.product = seen.columns.transpose() * seen.torque;
  seen.squares = seen.torque.squaredNorm();
  MatrixXd whole = x;
  whole.col(0) = Kept(c.rigid.force, used);
  seen.scaled =
      (y - whole * SolveScaled(GramOf(whole), whole.transpose() * y)).squaredNorm() + 1e-300;
  return seen;
}

/// Sum over joints of the logarithms of their residuals under a gravity of direction u.
double LeftOfAll(const std::vector<Seen>& seen, const Vector3d& u) {
  double sum = 0;
  for (const Seen& one : seen) sum += std::log(one.Left(u)) / 2;
  return sum;
}

/// The direction that leaves least: the best of points spread over the sphere (a golden spiral), and from there by shrinking steps across.
Vector3d BestDirection(const std::vector<Seen>& seen) {
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  Vector3d best = Vector3d::UnitZ();
  double least = LeftOfAll(seen, best);
  const auto try_one = [&](const Vector3d& u) {
    const double left = LeftOfAll(seen, u);
    if (!(left < least)) return false;
    least = left, best = u;
    return true;
  };
  for (int i = 0; i < kTriedDirections; ++i) {
    const double z = 1 - (2 * i + 1.0) / kTriedDirections, r = std::sqrt(1 - z * z);
    try_one({r * std::cos(golden * i), r * std::sin(golden * i), z});
  }
  for (double step = kTurnSpacing; step > kFinestTurn; step /= 2) {
    for (bool better = true; better;) {
      better = false;
      const Eigen::Matrix<double, 3, 2> across = Across(best);
      for (const double sign : {-1.0, 1.0}) {
        for (const Index axis : {0, 1}) {
          better |= try_one((best + sign * step * across.col(axis)).normalized());
        }
      }
    }
  }
  return best;
}

/// Whether the torques hold none of a gravity along u, g m/s^2, that would stand out of two of them. Of a torque in another unit one gain
/// explains inertia and gravity alike; where gravity was taken off, that is no better than none.
bool IsTakenOff(const std::vector<Seen>& seen, const Vector3d& u, double g) {
  std::size_t would_show = 0;
  double explained = 0;  // logarithm
  for (const Seen& one : seen) {
    if (!one.is_torque) continue;
    if (g * g * u.dot(one.gram * u) < kClearFall * kClearFall * one.Left(u)) continue;
    if (one.Share(u) > kTakenOff * g) return false;
    ++would_show;
    explained += std::log((one.squares + 1e-300) / one.scaled);
  }
  return would_show >= kFewestFallen && explained <= 0;
}

}  // namespace

Eigen::Matrix<double, 3, 2> Across(const Vector3d& u) {
  const Vector3d first = u.unitOrthogonal();
  Eigen::Matrix<double, 3, 2> across;
  across << first, u.cross(first);
  return across;
}

GravityFound FindGravity(const RobotData& data, const RobotRows& rows,
                         const std::vector<Index>& joints) {
  GravityFound found;
  const double g = rows.gravity.in_torque.norm();
  if (!(g > 0)) return found;
  const Vector3d described = rows.gravity.in_torque / g;
  const RobotRows thinned = Thinned(data, rows, kGravitySamples);
  std::vector<Seen> seen;
  for (const Index j : joints) seen.push_back(SeenBy(data, thinned, j));
  if (IsTakenOff(seen, described, g)) {
    found.held = GravityHeld::taken_off;
    return found;
  }
  const Vector3d u = BestDirection(seen);
  std::size_t fallen = 0;
  for (const Seen& one : seen) {
    const double falls = std::log(one.Left(described) / one.Left(u)) / 2;
    found.falls += falls;
    if (falls >= std::log(kClearFall)) ++fallen;
  }
  if (fallen < kFewestFallen) return found;
  found.held = GravityHeld::turned;
  found.vector = g * u;
  return found;
}

std::string ExplainGravity(const GravityFound& found, const Vector3d& described) {
  if (found.held == GravityHeld::taken_off) {
    return "the torques hold no gravity: it was taken off before they were logged, and the fit "
           "takes none";
  }
  const Vector3d& g = found.vector;
  const Vector3d reach = kNormal95 * found.covariance.diagonal().cwiseSqrt();
  const double angle = std::atan2(g.cross(described).norm(), g.dot(described));
  return fmt::format(
      "the base does not stand as the description says: gravity is ({:.3g} +- {:.2g}, {:.3g} +- "
      "{:.2g}, {:.3g} +- "
      "{:.2g}) m/s^2 in its axes, turned by {:.0f} degrees, and is fitted so (--gravity "
      "{:.3g},{:.3g},{:.3g} says it, "
      "--gravity {:g},{:g},{:g} denies it)",
      g[0], reach[0], g[1], reach[1], g[2], reach[2], angle * 180 / std::numbers::pi, g[0], g[1],
      g[2], described[0], described[1], described[2]);
}

}  // namespace warmjoint
