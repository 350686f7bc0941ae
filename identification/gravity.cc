#include "identification/gravity.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace warmjoint::inline identification {
namespace {

/// The knot at or below a position, and the share of the way to the next.
std::pair<int, double> Below(double position) {
  const double cells = position / kKnotSpacing;
  const double whole = std::floor(cells);
  const int knot = static_cast<int>(std::fmod(whole, kGravityKnots));
  // on one turn, also for positions below 0
  return {(knot + kGravityKnots) % kGravityKnots, cells - whole};
}

/// Index of a knot among those known, or -1.
Eigen::Index IndexOf(const std::vector<int>& knots, int knot) {
  const auto found = std::lower_bound(knots.begin(), knots.end(), knot % kGravityKnots);
  return found != knots.end() && *found == knot % kGravityKnots ? found - knots.begin() : -1;
}

}  // namespace

std::string_view GravityName(GravityKind kind) {
  switch (kind) {
    case GravityKind::sincos:
      return "sincos";
    case GravityKind::paired:
      return "paired";
    case GravityKind::constant:
      return "constant";
  }
  return "";
}

bool GravityModel::Covers(double position) const {
  if (kind != GravityKind::paired) return true;
  const int below = Below(position).first;
  return IndexOf(knots, below) >= 0 && IndexOf(knots, below + 1) >= 0;
}

Eigen::VectorXd GravityModel::Torque(const Eigen::VectorXd& position) const {
  return GravityColumns(kind, knots, position) * values;
}

Eigen::MatrixXd GravityColumns(GravityKind kind, const std::vector<int>& knots,
                               const Eigen::VectorXd& position) {
  const Eigen::Index n = position.size();
  if (kind == GravityKind::constant) return Eigen::MatrixXd::Ones(n, 1);
  if (kind == GravityKind::sincos) {
    Eigen::MatrixXd columns(n, 2);
    columns << position.array().sin(), position.array().cos();
    return columns;
  }

  // a hat over each knot
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(n, static_cast<Eigen::Index>(knots.size()));
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto [knot, share] = Below(position[i]);
    const Eigen::Index below = IndexOf(knots, knot), above = IndexOf(knots, knot + 1);
    // beside a knot that is missing nothing is known of the torque
    if (below < 0 || above < 0) continue;
    columns(i, below) += 1 - share;
    columns(i, above) += share;
  }
  return columns;
}

}  // namespace warmjoint::inline identification
