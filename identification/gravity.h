// Gravity along a joint, G(p) of Eq. (6), as identification estimates it.
#pragma once

#include <warmjoint/estimate.h>

#include <Eigen/Core>
#include <numbers>
#include <vector>

#include "models/foundation/node.h"

namespace warmjoint {

inline constexpr int kGravityKnots = 64;  // on a turn; a line misses g sin p by g (2 pi/64)^2/8
inline constexpr double kKnotSpacing = 2 * std::numbers::pi / kGravityKnots;  // rad

/// The cell of the turn that holds a position (rad), of which knot i begins the i-th.
int CellOf(double position);

/// {kind, sine, cosine}, {kind, position[] (rad), torque[]} or {kind, offset}; N.m or N. Throws BadInput.
void ReadValue(const Node& node, GravityModel* value, const FieldInfo& info);
Tree WriteValue(const GravityModel& value);

/// dG/dg at each position, one column for each value. A position outside of the knots has zeros.
/// position: [N] rad or m; returns [N x m].
Eigen::MatrixXd GravityColumns(GravityKind kind, const std::vector<int>& knots,
                               const Eigen::VectorXd& position);

}  // namespace warmjoint
